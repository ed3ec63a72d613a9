/* What is wrong while the kiosk runs on: one text of each kind, which ends once that is cured. */
#ifndef GN_KIOSK_PROBLEMS_H
#define GN_KIOSK_PROBLEMS_H

/* The order matters: a reload ends those from CONFIG to SCENE. */
enum gn_problem {
    GN_PROBLEM_START,   /* of this start, for good */
    GN_PROBLEM_CONTROL, /* no control socket; until it opens */
    GN_PROBLEM_TRIAL,   /* what was new is not shown; until something new is */
    GN_PROBLEM_CONFIG,  /* of kiosk.ini; until a reload succeeds, like the next three */
    GN_PROBLEM_FIRST,   /* the scene of the options is not shown: at the start another one is, after
                            a failed reload the one before */
    GN_PROBLEM_FONT,
    GN_PROBLEM_INPUT,      /* no buttons */
    GN_PROBLEM_ACTION,     /* an action's mode or clip is not there; until another one's is, or a
                               reload */
    GN_PROBLEM_MODE,       /* until that mode is shown, or a reload */
    GN_PROBLEM_SCENE,      /* likewise */
    GN_PROBLEM_WATCH,      /* changes of files are not noticed */
    GN_PROBLEM_SHADERS,    /* of --shaders; until they can be used */
    GN_PROBLEM_CLOCK,      /* [sun] needs one that is set; until it is */
    GN_PROBLEM_STATE,      /* until it is saved */
    GN_PROBLEM_TELEVISION, /* until it answers */
    GN_PROBLEM_RANGE,      /* until a connector has it, or none is asked for */
    GN_PROBLEM_GRAPHICS,   /* GL does not work; until it does */
    GN_PROBLEM_VOLTAGE,    /* of the board; until it was well for a minute, like the next two */
    GN_PROBLEM_THROTTLED,
    GN_PROBLEM_CMA,
    GN_PROBLEM_COUNT,
};
struct gn_problems {                /* zeroed: none */
    char of[GN_PROBLEM_COUNT][512]; /* "": none */
    unsigned begun[GN_PROBLEM_COUNT], count;
    int mode, scene; /* that cannot be shown */
};

/* Prints a text that differs from the last of its kind as a warning to stderr. */
void gn_problem_report(struct gn_problems *problems, enum gn_problem kind, const char *text);
void gn_problem_cure(struct gn_problems *problems, enum gn_problem kind);
/* The same of what somebody did now: it is the last one, also if it happened before. */
void gn_problem_report_again(struct gn_problems *problems, enum gn_problem kind, const char *text);
/* The last that is not cured, or NULL. */
const char *gn_problem_last(const struct gn_problems *problems);
/* The kind of that; GN_PROBLEM_COUNT: none. */
enum gn_problem gn_problem_last_kind(const struct gn_problems *problems);

/* What a screen in a public place says: no paths, no names of techniques, no texts of the system.
 * Sentences, without markup. */
struct gn_problem_words {
    const char *title;
    const char *advice; /* what to do, one sentence */
};
extern const struct gn_problem_words gn_problem_words[GN_PROBLEM_COUNT];

#endif
