/* The text console under the screen: quiet while we show pictures, and told to ask before it
 * switches. Where there is none (a container, a service without a terminal) nothing is done. */
#ifndef GN_DISPLAY_KMS_CONSOLE_H
#define GN_DISPLAY_KMS_CONSOLE_H

#include <stdbool.h>

#include "core/loop.h"

struct gn_console {
    int tty; /* -1: none */
    struct gn_signals signals;
    bool leaves;  /* it wants to switch: call gn_console_let_go() once the screen is free */
    bool entered; /* the screen is ours again; whoever reads it clears it */
};

/* Blocks SIGUSR1 and SIGUSR2 for good: to be called before other threads are made. */
void gn_console_open(struct gn_console *console, struct gn_loop *loop);
void gn_console_let_go(struct gn_console *console);
/* It shows text again, whoever left it without: one of us that was killed, or a splash. */
void gn_console_close(struct gn_console *console);

#endif
