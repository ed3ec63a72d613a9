/* What screens go through, as short plays: each begins in a world of its own, and ends with
 * something that can be seen. */
#ifndef GN_KMS_SCENES_H
#define GN_KMS_SCENES_H

#include "client.h"

struct scene {
    const char *name;
    void (*build)(void);            /* the world */
    void (*play)(struct client *c); /* between the opening and the end; NULL: a few frames */
    struct gn_screen_opts opts;
    int64_t slack_ns; /* it may take that much longer than others */
    bool may_give_up;
    bool put_back;     /* the console's picture is there again when it has ended */
    bool needs_atomic; /* what it shows cannot be mended by the older interface */
};
extern const struct scene scenes[];
extern const int scene_count;

/* The scene from its beginning to a picture that stays, or a complaint; then the end of the world.
 * `prepare`, if not NULL, is called when the world is built. */
struct ending {
    int64_t took_ns; /* to a right picture, from the play's end */
    long frames, calls;
    bool gave_up;
    char complaint[240]; /* "": all is well */
};
struct ending scene_run(const struct scene *scene, void (*prepare)(void *), void *context);

#endif
