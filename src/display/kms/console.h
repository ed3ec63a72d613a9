/* The text console under the screen: quiet while we show pictures, and told to ask before it
 * switches. Where there is none (a container, a service without a terminal) nothing is done. */
#ifndef GN_DISPLAY_KMS_CONSOLE_H
#define GN_DISPLAY_KMS_CONSOLE_H

#include <stdbool.h>

struct gn_console {
    int tty;     /* -1: none */
    int signals; /* a signalfd: readable when it wants to switch; -1 */
};

/* Blocks SIGUSR1 and SIGUSR2 for good: to be called before other threads are made. */
void gn_console_open(struct gn_console *console);
/* Reads the signals: *left: it wants the screen, call gn_console_let_go() once that is free;
 * *entered: the screen is ours again. */
void gn_console_read(struct gn_console *console, bool *left, bool *entered);
void gn_console_let_go(struct gn_console *console);
/* It shows text again, whoever left it without: one of us that was killed, or a splash. */
void gn_console_close(struct gn_console *console);

#endif
