/* What somebody does at a window becomes a view. */
#ifndef GN_KIOSK_POINTER_H
#define GN_KIOSK_POINTER_H

#include "stage/stage.h"

/* Moves the stage's orbit as the hand on its screen did. True: there is another picture to be seen.
 */
bool gn_show_hand_turn(struct gn_stage *stage, const struct gn_hand *hand);

#endif
