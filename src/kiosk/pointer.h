/* Applies the pointer's moves to the view. */
#ifndef GN_KIOSK_POINTER_H
#define GN_KIOSK_POINTER_H

#include "stage/stage.h"

/* Moves the stage's orbit. Returns true if the view changed. */
bool gn_show_pointer_turn(struct gn_stage *stage, const struct gn_pointer *pointer);

#endif
