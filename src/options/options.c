#include "options/options.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

#include "frame/plan.h"
#include "options/value.h"

#define BIT(command) (1u << GN_COMMAND_##command)
#define KIOSK        (BIT(AUTO) | BIT(SHOW))
#define DRAW         (KIOSK | BIT(RENDER) | BIT(BENCH))
#define ANY          ((1u << GN_COMMAND_COUNT) - 1)
#define FIELD(name)  offsetof(struct gn_options, name)

static const struct gn_choice backends[] = {{"auto", 0}, {"kms", 0},    {"window", 0},
                                            {"egl", 0},  {"osmesa", 0}, {0}};
static const struct gn_choice map_formats[] = {{"auto", 0},
                                               {"depth", 0},
                                               {"r32ui", 0},
                                               {"r16f", 0},
                                               {"r16f-raw", 0},
                                               {"rgba8", 0},
                                               {"rg32ui", 0},
                                               {"rgba16ui", 0},
                                               {"rgba16f", 0},
                                               {"rgba32f-bits", 0},
                                               {"rgba32f-share", 0},
                                               {"rgba32ui", 0},
                                               {0}};
static const struct gn_choice aovs[] = {
    {"color", GN_AOV_COLOR},       {"visibility", GN_AOV_VISIBILITY},
    {"distance", GN_AOV_DISTANCE}, {"normal", GN_AOV_NORMAL},
    {"map", GN_AOV_COUNT},         {0}};
static const struct gn_choice outputs[] = {
    {"srgb", GN_PICTURE_SRGB}, {"linear", GN_PICTURE_LINEAR}, {0}};
static const struct gn_choice planar_ways[] = {{"mask", 0}, {"stencil", 1}, {0}};
static const struct gn_choice samples[] = {{"0", 0}, {"2", 2}, {"4", 4}, {0}};
static const struct gn_choice tap_counts[] = {{"8", 8}, {"16", 16}, {"32", 32}, {0}};
static const struct gn_choice idles[] = {
    {"none", GN_IDLE_NONE}, {"first", GN_IDLE_FIRST}, {"next", GN_IDLE_NEXT}, {0}};
static const struct gn_choice turns[] = {{"0", 0}, {"90", 90}, {"180", 180}, {"270", 270}, {0}};

const struct gn_command_row gn_commands[GN_COMMAND_COUNT] = {
    [GN_COMMAND_AUTO] =
        {NULL, "[OPTION..] [SCENE]",
         "shows a scene: in a window, without a desktop full screen, else as gnomon.png"},
    [GN_COMMAND_SHOW] = {"show", "show [OPTION..] [SCENE..]",
                         "the kiosk: full screen without a desktop, runs until it is told to end"},
    [GN_COMMAND_RENDER] = {"render", "render [OPTION..] [SCENE] -o FILE",
                           "draws into a file: .png, .pfm, or frame-%04d.png with --frames"},
    [GN_COMMAND_BENCH] =
        {"bench", "bench [OPTION..] [SCENE]",
         "measures: time per frame and pass, draws, triangles, bytes, first picture, memory"},
    [GN_COMMAND_INSPECT] = {"inspect", "inspect [OPTION..] [SCENE]",
                            "says what is in a scene, what it costs and what is wrong with it"},
    [GN_COMMAND_DOCTOR] = {"doctor", "doctor [OPTION..]",
                           "says what this machine can do, and the cure for what it cannot"},
    [GN_COMMAND_CTL] = {"ctl", "ctl [OPTION..] COMMAND [WORD..]", "talks to a running kiosk"},
};

/* clang-format off */
const struct gn_option_row gn_option_rows[GN_OPTION_COUNT] = {
    /* the scene, and how it stands */
    {.name = "scene", .key = "file", .section = "scene", .kind = GN_KIND_SCENES, .value = "FILE",
     .help = "the scene (.glb, .gltf, .obj, .fbx, .stl, .ply, .dae); given again it adds one that next-scene goes on to; on the command line it needs no flag", .offset = FIELD(scene)},
    {.name = "camera", .section = "scene", .kind = GN_KIND_TEXT, .value = "NAME|N",
     .help = "look through this camera of the scene", .commands = DRAW, .offset = FIELD(camera)},
    {.name = "animation", .section = "scene", .kind = GN_KIND_TEXT, .value = "NAME|N|none",
     .help = "play only this clip; without it, all that do not collide", .commands = DRAW, .offset = FIELD(animation)},
    {.name = "no-animation", .section = "scene", .kind = GN_KIND_FLAG,
     .help = "leave the nodes as the file places them", .commands = DRAW, .offset = FIELD(no_animation)},
    {.name = "time", .section = "scene", .kind = GN_KIND_SECONDS, .max = 1e9, .value = "S", .unit = "seconds", .fallback = "0",
     .help = "start at this time of the animation", .commands = DRAW, .offset = FIELD(time_ns)},
    {.name = "turntable", .section = "scene", .kind = GN_KIND_NUMBER, .min = -3600, .max = 3600, .value = "DEG",
     .unit = "degrees per second", .fallback = "0",
     .help = "turn the camera around the scene", .commands = DRAW, .offset = FIELD(turntable_deg_s)},
    /* the picture */
    {.name = "size", .section = "render", .kind = GN_KIND_SIZE, .min = 1, .max = 16384, .value = "WxH", .unit = "pixels",
     .fallback = "1280x720", .help = "size of the picture", .commands = DRAW, .offset = FIELD(size)},
    {.name = "shadow", .section = "render", .kind = GN_KIND_TECHNIQUES, .value = "TECHNIQUE", .fallback = "pcf",
     .help = "shadow technique, for bench also a list with commas", .commands = DRAW, .offset = FIELD(shadow)},
    {.name = "map", .section = "render", .kind = GN_KIND_INT, .min = 16, .max = 16384, .value = "PX", .unit = "pixels",
     .fallback = "1024", .help = "side of a shadow map, and of the table of one; of vssm and smsm 512 by itself", .commands = DRAW, .offset = FIELD(map_px)},
    {.name = "map-format", .section = "render", .kind = GN_KIND_WORD, .choices = map_formats, .value = "FORMAT", .fallback = "auto",
     .help = "how a shadow map stores distance; from rg32ui on: what is kept of one that is filtered", .commands = DRAW, .offset = FIELD(map_format)},
    {.name = "planar", .section = "render", .kind = GN_KIND_CHOICE, .choices = planar_ways, .value = "WAY", .fallback = "mask",
     .help = "planar shadows by a map in the plane, with soft edges, or by the picture's stencil, with exact ones", .commands = DRAW, .offset = FIELD(planar_in_stencil)},
    {.name = "taps", .section = "render", .kind = GN_KIND_CHOICE, .choices = tap_counts, .value = "N", .fallback = "16",
     .help = "how many samples disk, poisson and pcss take", .commands = DRAW, .offset = FIELD(taps)},
    {.name = "taps-fixed", .section = "render", .kind = GN_KIND_FLAG,
     .help = "take them alike in every pixel: bands instead of grain", .commands = DRAW, .offset = FIELD(taps_fixed)},
    {.name = "filter-budget", .section = "render", .kind = GN_KIND_NUMBER, .max = 10000, .value = "N", .unit = "million texels", .fallback = "4",
     .help = "filtered maps that one frame makes again, when many lights move; the others wait a frame; 0: all", .commands = KIOSK, .offset = FIELD(filter_budget)},
    {.name = "shadow-strength", .section = "render", .kind = GN_KIND_NUMBER, .max = 1, .value = "X", .fallback = "1",
     .help = "how much direct light a shadow takes away", .commands = DRAW, .offset = FIELD(shadow_strength)},
    {.name = "show-lights", .section = "render", .kind = GN_KIND_FLAG,
     .help = "draw a mark where each light stands", .commands = DRAW, .offset = FIELD(show_lights)},
    {.name = "show-maps", .section = "render", .kind = GN_KIND_FLAG,
     .help = "show the lights' shadow maps along the lower edge of the picture", .commands = DRAW, .offset = FIELD(show_maps)},
    {.name = "light", .section = "render", .kind = GN_KIND_INT, .max = 65535, .value = "N", .fallback = "0",
     .help = "the light that --aov visibility and map show", .commands = BIT(RENDER), .offset = FIELD(light)},
    {.name = "aov", .section = "render", .kind = GN_KIND_CHOICE, .choices = aovs, .value = "WHAT", .fallback = "color",
     .help = "what to draw", .commands = BIT(RENDER), .offset = FIELD(aov)},
    {.name = "output", .section = "render", .kind = GN_KIND_CHOICE, .choices = outputs, .value = "SPACE", .fallback = "srgb",
     .help = "linear writes linear colour as it is, for measurement", .commands = BIT(RENDER) | BIT(BENCH), .offset = FIELD(output)},
    {.name = "exposure", .section = "render", .kind = GN_KIND_EV, .min = -24, .max = 24, .value = "auto|EV", .unit = "stops",
     .fallback = "auto", .help = "brightness: 0 shows radiance 1 as white", .commands = DRAW, .offset = FIELD(exposure_ev)},
    {.name = "msaa", .section = "render", .kind = GN_KIND_CHOICE, .choices = samples, .value = "N", .unit = "samples", .fallback = "0",
     .help = "antialiasing; on a screen 4 where the GPU makes it cheap", .commands = DRAW, .offset = FIELD(msaa)},
    {.name = "font", .section = "render", .kind = GN_KIND_PATH, .value = "FILE",
     .help = "write captions in this font (.ttf, .otf); without it in DejaVu Sans or the like, where there is one", .commands = KIOSK | BIT(RENDER), .offset = FIELD(font)},
    {.name = "shaders", .section = "render", .kind = GN_KIND_PATH, .value = "DIR",
     .help = "read the shaders from this folder", .commands = DRAW | BIT(DOCTOR), .offset = FIELD(shaders)},
    {.name = "without", .section = "render", .kind = GN_KIND_CAPS, .value = "CAP,..",
     .help = "pretend that these capabilities, named as doctor prints them, are missing", .commands = DRAW | BIT(DOCTOR), .offset = FIELD(without)},
    {.name = "limit", .section = "render", .kind = GN_KIND_LIMIT, .min = 1, .max = 1099511627776.0, .value = "NAME=VALUE",
     .help = "a bound on what a scene may ask for; may be given again", .commands = DRAW | BIT(INSPECT), .offset = FIELD(limits)},
    /* where it goes */
    {.name = "backend", .section = "display", .kind = GN_KIND_WORD, .choices = backends, .value = "NAME", .fallback = "auto",
     .help = "where pictures are drawn", .commands = DRAW | BIT(DOCTOR), .offset = FIELD(backend)},
    {.name = "card", .section = "display", .kind = GN_KIND_TEXT, .value = "NAME",
     .help = "the display's card, as in /dev/dri/by-path; without it, the first with a monitor", .commands = KIOSK, .offset = FIELD(card)},
    {.name = "render-node", .section = "display", .kind = GN_KIND_PATH, .value = "FILE",
     .help = "the GPU that draws, as in /dev/dri/by-path; without it, the one that goes with the card", .commands = KIOSK, .offset = FIELD(render_node)},
    {.name = "connector", .section = "display", .kind = GN_KIND_TEXT, .value = "NAME",
     .help = "the display's connector; without it, the first connected", .commands = KIOSK, .offset = FIELD(connector)},
    {.name = "display-mode", .key = "mode", .section = "display", .kind = GN_KIND_MODE, .min = 16, .max = 16384,
     .value = "WxH@HZ", .help = "the display's mode; without it, its current or preferred one up to --max-mode", .commands = KIOSK, .offset = FIELD(display_mode)},
    {.name = "max-mode", .section = "display", .kind = GN_KIND_MODE, .min = 16, .max = 16384, .value = "WxH@HZ",
     .fallback = "1920x1080@60", .help = "a mode that is chosen unasked is no larger than this, and has no more pixels a second", .commands = KIOSK, .offset = FIELD(max_mode)},
    {.name = "modeline", .section = "display", .kind = GN_KIND_MODELINE, .value = "LINE",
     .help = "a mode that the display does not list, as the program cvt prints it, without its name", .commands = KIOSK, .offset = FIELD(modeline)},
    {.name = "rotate", .section = "display", .kind = GN_KIND_CHOICE, .choices = turns, .value = "DEG", .unit = "degrees",
     .fallback = "0", .help = "turn the picture clockwise for a display on its side", .commands = KIOSK, .offset = FIELD(rotate_deg)},
    {.name = "max-fps", .section = "display", .kind = GN_KIND_INT, .min = 1, .max = 1000, .value = "N", .unit = "frames per second",
     .help = "draw no faster than this; without it, as fast as the display", .commands = KIOSK, .offset = FIELD(max_fps)},
    {.name = "legacy", .section = "display", .kind = GN_KIND_FLAG,
     .help = "use the kernel's older interface for displays", .commands = KIOSK, .offset = FIELD(legacy)},
    /* what a kiosk does by itself */
    {.name = "idle", .section = "kiosk", .kind = GN_KIND_CHOICE, .choices = idles, .value = "WHAT", .fallback = "none",
     .help = "when nobody has done anything for a while, go back to the first mode, or on to the next", .commands = KIOSK, .offset = FIELD(idle)},
    {.name = "idle-after", .section = "kiosk", .kind = GN_KIND_SECONDS, .min = 1, .max = 86400, .value = "S", .unit = "seconds",
     .fallback = "60", .help = "how long that while is", .commands = KIOSK, .offset = FIELD(idle_after_ns)},
    {.name = "fade", .section = "kiosk", .kind = GN_KIND_SECONDS, .max = 10, .value = "S", .unit = "seconds", .fallback = "0",
     .help = "fade from one mode to the next for so long", .commands = KIOSK, .offset = FIELD(fade_ns)},
    /* what a kiosk lets itself be told, and says */
    {.name = "socket", .section = "kiosk", .kind = GN_KIND_PATH, .value = "PATH",
     .help = "the socket that ctl talks to; without it /run/gnomon/ctl, else $XDG_RUNTIME_DIR/gnomon/ctl", .commands = BIT(SHOW) | BIT(CTL), .offset = FIELD(socket)},
    {.name = "captions", .section = "kiosk", .kind = GN_KIND_FLAG, .fallback = "yes",
     .help = "name the mode when it changes", .offset = FIELD(captions)},
    {.name = "caption-seconds", .section = "kiosk", .kind = GN_KIND_SECONDS, .min = .1, .max = 60, .value = "S", .unit = "seconds",
     .fallback = "2", .help = "how long a caption stays", .offset = FIELD(caption_ns)},
    /* the command's own */
    {.name = "input-script", .kind = GN_KIND_PATH, .value = "FILE",
     .help = "press keys and buttons as this file says: TIME_S down|up|click NAME a line", .commands = BIT(SHOW), .offset = FIELD(input_script)},
    {.name = "config", .letter = 'c', .kind = GN_KIND_PATH, .value = "FILE",
     .help = "read this INI file", .commands = DRAW | BIT(INSPECT) | BIT(CTL), .offset = FIELD(config)},
    {.name = "check", .kind = GN_KIND_PATH, .value = "FILE",
     .help = "read this INI file as show would and check all that it names; print what it makes, and end", .commands = BIT(SHOW), .offset = FIELD(check)},
    {.name = "mode", .kind = GN_KIND_TEXT, .value = "NAME",
     .help = "start in this mode of the INI file, or with this technique", .commands = DRAW, .offset = FIELD(mode)},
    {.name = "out", .letter = 'o', .kind = GN_KIND_PATH, .value = "FILE",
     .help = "write to this file; %04d in it becomes the number of the frame", .commands = BIT(RENDER), .offset = FIELD(out)},
    {.name = "caption", .kind = GN_KIND_TEXT, .value = "TEXT",
     .help = "write this on the picture, as the kiosk writes what went wrong", .commands = BIT(RENDER), .offset = FIELD(caption)},
    {.name = "frames", .kind = GN_KIND_INT, .min = 1, .max = 1000000, .value = "N",
     .help = "how many frames; show ends after them", .commands = BIT(SHOW) | BIT(RENDER) | BIT(BENCH), .offset = FIELD(frames)},
    {.name = "fps", .kind = GN_KIND_NUMBER, .min = .001, .max = 1000, .value = "F", .unit = "frames per second", .fallback = "60",
     .help = "step of time between frames", .commands = BIT(RENDER), .offset = FIELD(fps)},
    {.name = "plan", .kind = GN_KIND_FLAG,
     .help = "also print the plan of the first frame", .commands = BIT(RENDER), .offset = FIELD(plan)},
    {.name = "json", .kind = GN_KIND_FLAG,
     .help = "print JSON", .commands = BIT(BENCH) | BIT(INSPECT) | BIT(DOCTOR) | BIT(CTL), .offset = FIELD(json)},
    {.name = "self-test", .kind = GN_KIND_FLAG,
     .help = "draw small scenes with every technique and compare them with the truth", .commands = BIT(DOCTOR), .offset = FIELD(self_test)},
    {.name = "stats", .kind = GN_KIND_FLAG,
     .help = "print a line a second: frames, what was missed, time to draw", .commands = BIT(SHOW), .offset = FIELD(stats)},
    {.name = "verbose", .letter = 'v', .kind = GN_KIND_FLAG,
     .help = "when the command fails, print warnings and the source of a failed shader too", .commands = ANY, .offset = FIELD(verbose)},
    {.name = "version", .letter = 'V', .kind = GN_KIND_FLAG,
     .help = "print the version", .commands = ANY, .offset = FIELD(version)},
    {.name = "help", .letter = 'h', .kind = GN_KIND_FLAG,
     .help = "print this; after a command, what that command takes", .commands = ANY, .offset = FIELD(help)},
};
/* clang-format on */

static size_t index_of(const struct gn_option_row *row) { return (size_t)(row - gn_option_rows); }

static const struct gn_option_row *end_of_rows(void) { return gn_option_rows + GN_OPTION_COUNT; }

const struct gn_option_row *gn_option_find(const char *name, size_t length) {
    for (const struct gn_option_row *row = gn_option_rows; row < end_of_rows(); row++)
        if (row->commands && strlen(row->name) == length && memcmp(row->name, name, length) == 0)
            return row;
    return NULL;
}

const struct gn_option_row *gn_option_find_letter(char letter) {
    for (const struct gn_option_row *row = gn_option_rows; row < end_of_rows(); row++)
        if (row->letter && row->letter == letter) return row;
    return NULL;
}

const char *gn_option_key(const struct gn_option_row *row, char *buffer, size_t size) {
    snprintf(buffer, size, "%s", row->key ? row->key : row->name);
    for (char *c = buffer; *c; c++)
        if (*c == '-') *c = '_';
    return buffer;
}

static bool in_section(const struct gn_option_row *row, const char *section) {
    if (!row->section) return false;
    if (section) return strcmp(row->section, section) == 0;
    return strcmp(row->section, "scene") == 0 || strcmp(row->section, "render") == 0;
}

const struct gn_option_row *gn_option_find_key(const char *section, const char *key) {
    char buffer[64];
    for (const struct gn_option_row *row = gn_option_rows; row < end_of_rows(); row++)
        if (in_section(row, section) && strcmp(gn_option_key(row, buffer, sizeof buffer), key) == 0)
            return row;
    return NULL;
}

static void *field_of(struct gn_options *options, const struct gn_option_row *row) {
    return (char *)options + row->offset;
}

void gn_options_init(struct gn_options *options) {
    struct gn_err err = {0};
    *options = (struct gn_options){0};
    for (const struct gn_option_row *row = gn_option_rows; row < end_of_rows(); row++) {
        bool ok = !row->fallback || gn_value_parse(row, row->fallback, field_of(options, row),
                                                   &options->arena, row->name, &err);
        assert(ok && "a default is in its own range");
        (void)ok;
    }
}

void gn_options_finish(struct gn_options *options) {
    gn_options_finish_changes(options);
    gn_arena_finish(&options->arena);
    *options = (struct gn_options){0};
}

void gn_options_put(struct gn_options *options, const struct gn_option_row *row, const void *value,
                    enum gn_source source, const char *label) {
    uint8_t *from = &options->source[index_of(row)];
    if (*from > source) return;
    memcpy(field_of(options, row), value, gn_value_size(row->kind));
    *from = (uint8_t)source;
    options->label[index_of(row)] = label;
}

bool gn_options_set(struct gn_options *options, const struct gn_option_row *row, const char *text,
                    enum gn_source source, const char *label, struct gn_err *err) {
    _Alignas(16) char value[sizeof(struct gn_limits)] = {0};
    if (options->source[index_of(row)] == source) /* NAME=VALUE adds */
        memcpy(value, field_of(options, row), gn_value_size(row->kind));
    if (!gn_value_parse(row, text, value, &options->arena, label, err)) return false;
    const char *kept = gn_arena_strdup(&options->arena, label);
    if (!kept) return gn_fail(err, "%s: no memory left", label);
    gn_options_put(options, row, value, source, kept);
    return true;
}

static size_t index_of_field(size_t offset) {
    size_t i = 0;
    while (i < GN_OPTION_COUNT && gn_option_rows[i].offset != offset) i++;
    assert(i < GN_OPTION_COUNT && "a field of the table");
    return i;
}

enum gn_source gn_options_source(const struct gn_options *options, size_t offset) {
    return options->source[index_of_field(offset)];
}

const char *gn_options_label_at(const struct gn_options *options, size_t offset) {
    const char *label = options->label[index_of_field(offset)];
    return label ? label : gn_option_rows[index_of_field(offset)].name;
}

/* ---- modes --------------------------------------------------------------------------------- */

void gn_options_drop_mode(struct gn_options *options) {
    for (size_t i = 0; i < GN_OPTION_COUNT && options->base; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        if (options->source[i] != GN_SOURCE_MODE) continue;
        memcpy(field_of(options, row), field_of(options->base, row), gn_value_size(row->kind));
        options->source[i] = options->base->source[i];
        options->label[i] = options->base->label[i];
    }
    options->mode_now = NULL;
}

static bool remember_base(struct gn_options *options) {
    if (!options->base) options->base = gn_arena_alloc(&options->arena, 1, sizeof *options);
    if (options->base) *options->base = *options;
    return options->base;
}

static bool fail_no_mode(const struct gn_options *options, const char *name, struct gn_err *err) {
    char names[300] = "";
    size_t used = 0;
    for (int i = 0; i < options->mode_count && used < sizeof names; i++)
        used += (size_t)snprintf(names + used, sizeof names - used, "%s \"%s\"", i ? "," : "",
                                 options->modes[i].name);
    return gn_fail_usage(err, "no mode \"%.48s\"; %s has%s", name, options->config_path, names);
}

static void apply_found(struct gn_options *options, const struct gn_mode *mode) {
    for (int i = 0; i < mode->count; i++)
        gn_options_put(options, mode->settings[i].row, mode->settings[i].value, GN_SOURCE_MODE,
                       mode->settings[i].label);
    options->mode_now = mode->name;
}

/* Without modes in an INI file each technique is one. */
static void apply_technique(struct gn_options *options, const char *name) {
    gn_options_put(options, gn_option_find("shadow", strlen("shadow")), &name, GN_SOURCE_MODE,
                   "--mode");
    options->mode_now = name;
}

static const struct gn_mode *find_mode(const struct gn_options *options, const char *name) {
    for (int i = 0; i < options->mode_count; i++)
        if (strcmp(options->modes[i].name, name) == 0) return &options->modes[i];
    return NULL;
}

bool gn_options_apply_mode(struct gn_options *options, const char *name, struct gn_err *err) {
    const struct gn_mode *mode = find_mode(options, name);
    enum gn_technique unused;
    if (!mode && options->mode_count) return fail_no_mode(options, name, err);
    if (!mode && !gn_technique_find(name, &unused, err)) return false;
    gn_options_drop_mode(options);
    if (!remember_base(options)) return gn_fail(err, "mode \"%s\": no memory left", name);
    if (mode)
        apply_found(options, mode);
    else
        apply_technique(options, name);
    return true;
}
