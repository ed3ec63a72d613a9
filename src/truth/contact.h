/* The gap at contacts (peter-panning). A contact is a dark pixel on a surface that faces the light,
 * next to (and not merely in front of) a surface that turns away from it: the foot of a wall on its
 * shadow side. Its gap is the way, as the light sees it, to the nearest dark pixel of the shot on
 * the same item. */
#ifndef GN_TRUTH_CONTACT_H
#define GN_TRUTH_CONTACT_H

#include "truth/sight.h"

struct gn_contact {
    int contacts;            /* pixels */
    double mean, p99, worst; /* texels */
};
/* shot: of the same size; the first of so many channels counts; below .5 is dark. */
void gn_contact_compare(const struct gn_truth *truth, const float *shot, int channels,
                        unsigned map_px, struct gn_contact *contact);

#endif
