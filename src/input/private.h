/* Parts of an input, and the system interfaces that tests replace. */
#ifndef GN_INPUT_PRIVATE_H
#define GN_INPUT_PRIVATE_H

#include "input/devices.h"
#include "input/input.h"
#include "input/lines.h"
#include "input/play.h"
#include "input/source.h"
#include "input/terminal.h"

struct gn_input_world {             /* zero means the default written beside */
    const struct gn_gpio_ops *gpio; /* libgpiod */
    void *gpio_context;
    const struct gn_evdev_ops *evdev; /* evdev */
    void *evdev_context;
    const char *folder;  /* "/dev" */
    const int *terminal; /* stdin */
};

struct gn_input {
    struct gn_input_opts opts;
    struct gn_gestures gestures;
    struct gn_reports reports;
    struct gn_keys keys;
    struct gn_lines lines;
    struct gn_devices devices;
    struct gn_play play;
    struct gn_key_source window;
    void *states[GN_SOURCE_COUNT]; /* of sources that have no field here */
    char devices_folder[64];
    struct gn_timer timer;           /* due when anything is due or readable */
    struct gn_watch notify;          /* inotify; fd -1: folders are scanned every 2 s */
    bool folders_changed;            /* notify is readable */
    int folder_watch, devices_watch; /* -1: not watched */
    int64_t poll_ns;                 /* when to scan the folders; INT64_MAX: never */
    unsigned reported_dropped;
};

struct gn_input *gn_input_open_in(const struct gn_input_world *world,
                                  const struct gn_input_opts *opts, int64_t now_ns,
                                  struct gn_warnings *warnings, struct gn_err *err);

/* As gn_input_list_lines() in another folder than /dev. */
void gn_input_list_in(const struct gn_input_world *world, struct gn_input_list *out);

/* setup.c: converts options of buttons to gestures, lines and keys. */
bool gn_input_set_up(struct gn_input *input, int64_t now_ns, struct gn_err *err);

#endif
