/* What the buttons go through where kiosk.ini has no modes and the scene is the user's own: a list
 * of modes made of the scene. Pure. Of these, the first that there is:
 *
 *   cameras    two or more in the file
 *   scenes     two or more in the configuration; after the cameras of the one that is shown
 *   variants   two or more of KHR_materials_variants
 *   clip       one mode, whose clips begin anew with each press
 *   turntable  two modes, with and without
 *
 * What the command line or `ctl set` has chosen is not gone through. */
#ifndef GN_KIOSK_OFFERS_H
#define GN_KIOSK_OFFERS_H

#include "kiosk/machine.h"
#include "options/settings.h"
#include "stage/stage.h"

struct gn_offers_of {
    const struct gn_scene *scene;
    const struct gn_settings *settings; /* those without any mode */
    int clips;                          /* that play, as gn_pose_init() has them */
    const char *const *paths;           /* of the scenes of next-scene; NULL: the default scene */
    int path_count, shown;              /* 1 or more; the place of `scene` among them */
};
struct gn_offer {
    char name[64];
    int camera, variant; /* -1: as the settings have it */
    int scene;           /* its place in paths; -1: the one that is shown */
    bool turns;          /* the other of with and without a turntable */
};
struct gn_offers {
    int count;
    int first;                                 /* what the settings show */
    int home;                                  /* what GN_IDLE_FIRST goes to: of the first scene */
    bool replays;                              /* a press begins the clips anew */
    struct gn_offer items[GN_KIOSK_MODES_MAX]; /* each name once */
};

/* The turntable where the settings have none, degrees per second. */
#define GN_OFFER_TURNTABLE_DEG_S 6.0

void gn_offers_build(const struct gn_offers_of *of, struct gn_offers *out);
/* The name of one on the screen. */
const char *gn_offer_title(const struct gn_offer *offer);
/* Puts a offer into the look of a scene, which need not be the one that it was made of. */
void gn_offer_apply(const struct gn_offer *offer, const struct gn_settings *settings,
                    const struct gn_scene *scene, struct gn_stage_look *look);

#endif
