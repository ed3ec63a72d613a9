#include "input/keys.h"

#include <stdio.h>
#include <string.h>

bool gn_keys_bind(struct gn_keys *keys, int button, const char *names, struct gn_err *err) {
    bool any = false;
    for (const char *at = names; *(at += strspn(at, " \t"));) {
        char name[32];
        const size_t length = strcspn(at, " \t");
        snprintf(name, sizeof name, "%.*s", (int)(length < 64 ? length : 64), at);
        const unsigned key = length < sizeof name ? gn_key_find(name) : GN_KEY_NONE;
        if (key == GN_KEY_NONE)
            return gn_fail_usage(
                err,
                "unknown key \"%s\"; expected a name such as space, right, f1, btn_0, or "
                "key_NUMBER as `evtest` prints it",
                name);
        keys->buttons[key] |= UINT32_C(1) << button;
        keys->bound[key / 8] |= (uint8_t)(1u << key % 8);
        any = true;
        at += length;
    }
    return any || gn_fail_usage(err, "no key given");
}

bool gn_key_is_down(const uint8_t *bits, unsigned key) { return bits[key / 8] >> key % 8 & 1; }

enum change { DOWN, UP, HELD, GONE };

static void change_key(struct gn_keys *keys, struct gn_key_source *source, unsigned key,
                       enum change what, int64_t time_ns) {
    source->down[key / 8] ^= (uint8_t)(1u << key % 8);
    for (int i = 0; i < GN_BUTTONS_MAX; i++) {
        if (!(keys->buttons[key] >> i & 1)) continue;
        switch (what) {
        case DOWN:
        case UP: gn_gestures_key(keys->gestures, i, what == DOWN, time_ns); break;
        case HELD: gn_gestures_key_held(keys->gestures, i, time_ns); break;
        case GONE: gn_gestures_key_gone(keys->gestures, i, time_ns); break;
        }
    }
}

void gn_keys_set(struct gn_keys *keys, struct gn_key_source *source, unsigned key, bool down,
                 int64_t time_ns) {
    if (key >= GN_KEY_COUNT || !gn_key_is_down(keys->bound, key)) return;
    if (gn_key_is_down(source->down, key) != down)
        change_key(keys, source, key, down ? DOWN : UP, time_ns);
}

void gn_keys_set_all(struct gn_keys *keys, struct gn_key_source *source, const uint8_t *bits,
                     bool first, int64_t time_ns) {
    for (unsigned key = 0; key < GN_KEY_COUNT; key++) {
        const bool down = gn_key_is_down(bits, key);
        if (!gn_key_is_down(keys->bound, key) || gn_key_is_down(source->down, key) == down)
            continue;
        change_key(keys, source, key, !down ? UP : first ? HELD : DOWN, time_ns);
    }
}

void gn_keys_lose(struct gn_keys *keys, struct gn_key_source *source, int64_t time_ns) {
    for (unsigned key = 0; key < GN_KEY_COUNT; key++)
        if (gn_key_is_down(source->down, key)) change_key(keys, source, key, GONE, time_ns);
}

void gn_keys_click(struct gn_keys *keys, unsigned key, int64_t time_ns) {
    struct gn_key_source once = {0};
    gn_keys_set(keys, &once, key, true, time_ns);
    gn_keys_set(keys, &once, key, false, time_ns);
}
