/* Sequences of ECMA-48 (CSI, 5.4), xterm (ctlseqs, PC-style function keys) and the Linux console
 * (console_codes(4)). */
#include "input/terminal_keys.h"

#include <string.h>

#include "core/key.h"

enum state {
    PLAIN,
    ESCAPED /* ESC */,
    CSI /* ESC [ */,
    SS3 /* ESC O */,
    CONSOLE /* ESC [ [ */,
    OTHER
};

/* F1 to F20, as Linux numbers them */
static const uint8_t f_keys[] = {0,  59, 60,  61,  62,  63,  64,  65,  66,  67, 68,
                                 87, 88, 183, 184, 185, 186, 187, 188, 189, 190};

/* Printable characters are those of a US keyboard, with or without shift. */
static unsigned find_plain(uint8_t byte) {
    static const struct {
        const char *plain, *shifted;
        uint8_t first;
    } rows[] = {{"1234567890-=", "!@#$%^&*()_+", 2},
                {"qwertyuiop[]", "QWERTYUIOP{}", 16},
                {"asdfghjkl;'`", "ASDFGHJKL:\"~", 30},
                {"\\zxcvbnm,./", "|ZXCVBNM<>?", 43}};
    switch (byte) {
    case '\r':
    case '\n': return GN_KEY_ENTER;
    case '\t': return GN_KEY_TAB;
    case ' ': return GN_KEY_SPACE;
    case 8:
    case 127: return GN_KEY_BACKSPACE;
    default: break;
    }
    if (byte < ' ' || byte > 127) return GN_KEY_NONE;
    for (int i = 0; i < 4; i++) {
        const char *plain = strchr(rows[i].plain, byte), *shifted = strchr(rows[i].shifted, byte);
        if (plain) return rows[i].first + (unsigned)(plain - rows[i].plain);
        if (shifted) return rows[i].first + (unsigned)(shifted - rows[i].shifted);
    }
    return GN_KEY_NONE;
}

/* Final byte of ESC [ and ESC O. */
static unsigned find_letter(uint8_t byte) {
    switch (byte) {
    case 'A': return GN_KEY_UP;
    case 'B': return GN_KEY_DOWN;
    case 'C': return GN_KEY_RIGHT;
    case 'D': return GN_KEY_LEFT;
    case 'F': return GN_KEY_END;
    case 'H': return GN_KEY_HOME;
    case 'Z': return GN_KEY_TAB; /* with shift */
    case 'P':
    case 'Q':
    case 'R':
    case 'S': return f_keys[byte - 'P' + 1];
    default: return GN_KEY_NONE;
    }
}

static unsigned step_csi(struct gn_terminal_keys *keys, uint8_t byte) {
    if (byte >= '0' && byte <= '9') {
        if (!keys->more && keys->number < 100) keys->number = 10 * keys->number + (byte - '0');
        return GN_KEY_NONE;
    }
    if (byte == '[' && !keys->number && !keys->more) {
        keys->state = CONSOLE;
        return GN_KEY_NONE;
    }
    if (byte < 0x40) { /* parameter and intermediate bytes */
        if (byte >= '<' && !keys->number && !keys->more)
            keys->state = OTHER; /* a mouse event or a report */
        keys->more = true;
        return GN_KEY_NONE;
    }
    const bool other = keys->state == OTHER;
    keys->state = PLAIN;
    if (other) return GN_KEY_NONE;
    if (byte != '~') return find_letter(byte);

    /* the number before ~ */
    enum { INSERT = 110, DELETE = 111 };
    static const uint8_t numbered[] = {0,          GN_KEY_HOME,   INSERT,          DELETE,
                                       GN_KEY_END, GN_KEY_PAGEUP, GN_KEY_PAGEDOWN, GN_KEY_HOME,
                                       GN_KEY_END};
    static const uint8_t f_numbers[] = {0,  11, 12, 13, 14, 15, 17, 18, 19, 20, 21,
                                        23, 24, 25, 26, 28, 29, 31, 32, 33, 34};
    if (keys->number < (int)sizeof numbered) return numbered[keys->number];
    for (size_t i = 1; i < sizeof f_numbers; i++)
        if (f_numbers[i] == keys->number) return f_keys[i];
    return GN_KEY_NONE;
}

unsigned gn_terminal_keys_step(struct gn_terminal_keys *keys, uint8_t byte, int64_t now_ns) {
    const enum state state = (enum state)keys->state;
    if (byte == 27) { /* aborts any sequence; of two ESC the first is the key */
        *keys = (struct gn_terminal_keys){.state = ESCAPED, .esc_ns = now_ns};
        return state == ESCAPED ? GN_KEY_ESC : GN_KEY_NONE;
    }
    if (state != PLAIN && byte < ' ') keys->state = PLAIN; /* not valid inside a sequence */
    switch ((enum state)keys->state) {
    case ESCAPED:
        if (byte == '[' || byte == 'O') {
            keys->state = byte == '[' ? CSI : SS3;
            return GN_KEY_NONE;
        }
        break; /* with alt */
    case CSI:
    case OTHER: return step_csi(keys, byte);
    case SS3: keys->state = PLAIN; return byte == 'M' ? GN_KEY_ENTER : find_letter(byte);
    case CONSOLE:
        keys->state = PLAIN;
        return byte >= 'A' && byte <= 'E' ? f_keys[byte - 'A' + 1] : GN_KEY_NONE;
    case PLAIN: break;
    }
    keys->state = PLAIN;
    return find_plain(byte);
}

int64_t gn_terminal_keys_deadline(const struct gn_terminal_keys *keys) {
    return keys->state == PLAIN ? INT64_MAX : keys->esc_ns + GN_TERMINAL_ESC_NS;
}

unsigned gn_terminal_keys_wait(struct gn_terminal_keys *keys, int64_t now_ns) {
    if (now_ns < gn_terminal_keys_deadline(keys)) return GN_KEY_NONE;
    const bool alone = keys->state == ESCAPED;
    keys->state = PLAIN;
    return alone ? GN_KEY_ESC : GN_KEY_NONE;
}
