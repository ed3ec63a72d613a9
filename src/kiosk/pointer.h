/* Applies the pointer's moves to the view. */
#ifndef GN_KIOSK_POINTER_H
#define GN_KIOSK_POINTER_H

#include "input/input.h"
#include "stage/stage.h"

/* Adds moves on the glass of the screen and of mice to those of its window. */
void gn_show_pointer_add(const struct gn_screen *screen, const struct gn_input_moves *moves,
                         struct gn_pointer *pointer);
/* Moves the stage's orbit. Returns true if the view changed. */
bool gn_show_pointer_turn(struct gn_stage *stage, const struct gn_pointer *pointer);

#endif
