/* The virtual terminal under the screen: graphics mode while frames are shown, with VT switches
 * under our control (VT_PROCESS). Does nothing without a VT (container, service, ssh). */
#ifndef GN_DISPLAY_KMS_CONSOLE_H
#define GN_DISPLAY_KMS_CONSOLE_H

#include <stdbool.h>

#include "core/loop.h"

struct gn_console {
    int tty;         /* -1: none */
    int keyboard;    /* its keyboard mode, to be restored: K_UNICODE, K_XLATE */
    bool locks_keys; /* its keyboard is off */
    struct gn_signals signals;
    bool leaves; /* a switch away is requested: call gn_console_let_go() when the screen is released
                  */
    bool entered; /* switched back to us; whoever reads it clears it */
};

/* Blocks SIGUSR1 and SIGUSR2 permanently: call before creating threads. locked: the kernel ignores
 * keys while this VT is in front (K_OFF), so that neither Ctrl+Alt+F2 nor Ctrl+Alt+Del nor Ctrl+C
 * leads away; input devices are read as ever. */
void gn_console_open(struct gn_console *console, struct gn_loop *loop, bool locked);
void gn_console_let_go(struct gn_console *console);
/* Restores text mode and keyboard, also if a killed process or a splash left them otherwise. */
void gn_console_close(struct gn_console *console);

#endif
