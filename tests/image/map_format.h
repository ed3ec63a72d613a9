/* Formats of shadow maps by the names that the tables of tests have for them. */
#ifndef TESTS_IMAGE_MAP_FORMAT_H
#define TESTS_IMAGE_MAP_FORMAT_H

#include "shadow/technique.h"

/* By name, the encoding also by "auto"; without one of that name *out stays. */
void find_encoding(const char *name, enum gn_encoding *out);
void find_moments(const char *name, enum gn_moments *out);

#endif
