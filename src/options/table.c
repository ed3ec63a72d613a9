#include "options/table.h"

#include <stdio.h>
#include <string.h>

#include "cost/gpu.h"
#include "dial/dial.h"
#include "display/display.h"
#include "frame/frame.h"
#include "input/input.h"
#include "options/command.h"
#include "options/settings.h"

#define BIT(command) (1u << GN_COMMAND_##command)
#define KIOSK        (BIT(AUTO) | BIT(SHOW))
#define DRAW         (KIOSK | BIT(RENDER) | BIT(BENCH))
#define MODEL        (BIT(INSPECT) | BIT(FIT))
#define ANY          ((1u << GN_COMMAND_COUNT) - 1)
#define FIELD(name)  offsetof(struct gn_settings, name)
#define LIGHT(name)  offsetof(struct gn_light_opts, name)

static const struct gn_choice backends[] = {{"auto", 0},
#define X(file, name) {name, 0},
                                            GN_DISPLAY_TABLE(X)
#undef X
                                                {0}};
static const struct gn_choice gpus[] = {{"none", 0},
#define X(NAME, name, ...) {name, 1 + GN_COST_##NAME},
                                        GN_COST_GPUS(X)
#undef X
                                            {0}};
static const struct gn_choice dial_kinds[] = {
#define X(NAME, name) {name, GN_DIAL_##NAME},
    GN_DIAL_KINDS(X)
#undef X
        {0}};
static const struct gn_choice map_formats[] = {
    {"auto", GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_NONE)},
    {"depth", GN_MAP_FORMAT(GN_ENCODING_DEPTH, GN_MOMENTS_NONE)},
    {"r32ui", GN_MAP_FORMAT(GN_ENCODING_R32UI, GN_MOMENTS_NONE)},
    {"r16f", GN_MAP_FORMAT(GN_ENCODING_R16F, GN_MOMENTS_NONE)},
    {"r16f-raw", GN_MAP_FORMAT(GN_ENCODING_R16F_RAW, GN_MOMENTS_NONE)},
    {"rgba8", GN_MAP_FORMAT(GN_ENCODING_RGBA8, GN_MOMENTS_NONE)},
    {"depth16", GN_MAP_FORMAT(GN_ENCODING_DEPTH16, GN_MOMENTS_NONE)},
    {"rg32ui", GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_RG32UI)},
    {"rgba16ui", GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_RGBA16UI)},
    {"rgba16f", GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_RGBA16F)},
    {"rgba16f-mips", GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_RGBA16F_MIPS)},
    {"rgba32f-bits", GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_RGBA32F_BITS)},
    {"rgba32f-share", GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_RGBA32F_SHARE)},
    {"rgba32ui", GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_TABLE_RGBA32UI)},
    {"rg16f", GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_CONE_RG16F)},
    {"rg16f-bits", GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_CONE_BITS)},
    {"rg16f-bytes", GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_CONE_BYTES)},
    {0},
};
static const struct gn_choice environments[] = {{"auto", 0}, {"studio", 0}, {"none", 0}, {0}};
static const struct gn_choice states[] = {{"no", 0}, {0}};
static const struct gn_choice aovs[] = {
    {"color", GN_AOV_COLOR},         {"visibility", GN_AOV_VISIBILITY},
    {"distance", GN_AOV_DISTANCE},   {"normal", GN_AOV_NORMAL},
    {"occlusion", GN_AOV_OCCLUSION}, {"map", GN_AOV_MAP},
    {"sun-hours", GN_AOV_SUN_HOURS}, {0}};
static const struct gn_choice outputs[] = {
    {"srgb", GN_PICTURE_SRGB}, {"linear", GN_PICTURE_LINEAR}, {0}};
static const struct gn_choice tones[] = {{"auto", GN_TONE_AUTO}, {"neutral", GN_TONE_NEUTRAL},
                                         {"aces", GN_TONE_ACES}, {"agx", GN_TONE_AGX},
                                         {"none", GN_TONE_NONE}, {0}};
static const struct gn_choice occlusions[] = {
    {"auto", GN_OCCLUSION_AUTO}, {"none", GN_OCCLUSION_NONE}, {0}};
static const struct gn_choice gathers[] = {
    {"auto", GN_GATHER_AUTO}, {"none", GN_GATHER_NONE}, {"always", GN_GATHER_ALWAYS}, {0}};
static const struct gn_choice environment_shows[] = {{"no", GN_ENVIRONMENT_SHOW_NO},
                                                     {"yes", GN_ENVIRONMENT_SHOW_SHARP},
                                                     {"blur", GN_ENVIRONMENT_SHOW_BLUR},
                                                     {0}};
static const struct gn_choice backgrounds[] = {
    {"auto", GN_SHOW_SCENE}, {"transparent", GN_SHOW_TRANSPARENT}, {"sky", GN_SHOW_SKY}, {0}};
static const struct gn_choice planar_ways[] = {
    {"mask", GN_PLANAR_MASK}, {"stencil", GN_PLANAR_STENCIL}, {"soft", GN_PLANAR_SOFT}, {0}};
static const struct gn_choice lamp_points[] = {{"16", 16},   {"32", 32},   {"64", 64},
                                               {"128", 128}, {"256", 256}, {0}};
static const struct gn_choice samples[] = {
    {"auto", GN_MSAA_AUTO}, {"0", 0}, {"2", 2}, {"4", 4}, {0}};
static const struct gn_choice tap_counts[] = {
    {"auto", 0}, {"4", 4},   {"8", 8},   {"12", 12}, {"16", 16}, {"20", 20},
    {"24", 24},  {"28", 28}, {"32", 32}, {"36", 36}, {"40", 40}, {"44", 44},
    {"48", 48},  {"52", 52}, {"56", 56}, {"60", 60}, {"64", 64}, {0}};
static const struct gn_choice cascade_counts[] = {{"auto", 0}, {"1", 1}, {"2", 2},
                                                  {"3", 3},    {"4", 4}, {0}};
static const struct gn_choice cast_faces[] = {{"auto", 0},
                                              {"both", 1 + GN_CAST_BOTH},
                                              {"front", 1 + GN_CAST_FRONT},
                                              {"back", 1 + GN_CAST_BACK},
                                              {"middle", 1 + GN_CAST_MIDDLE},
                                              {0}};
static const struct gn_choice clip_turns[] = {
    {"loop", GN_POSE_LOOP}, {"once", GN_POSE_ONCE}, {"ping-pong", GN_POSE_PING_PONG}, {0}};
static const struct gn_choice map_ends[] = {{"far", 0}, {"near", 1}, {0}};
static const struct gn_choice slide_aspects[] = {{"square", 0}, {"picture", 1}, {0}};
static const struct gn_choice light_colors[] = {{"auto", -1}, {0}};
static const struct gn_choice follows[] = {{"world", 0}, {"camera", 1}, {0}};
static const struct gn_choice pointers[] = {
    {"touch", GN_POINTERS_TOUCH}, {"all", GN_POINTERS_ALL}, {"none", GN_POINTERS_NONE}, {0}};
static const struct gn_choice playings[] = {{"act", 0}, {"ignore", 1}, {0}};
static const struct gn_choice offs[] = {{"dpms", 0},
                                        {"black", GN_OFF_BLACK},
                                        {"cec", GN_OFF_CEC},
                                        {"cec-black", GN_OFF_CEC | GN_OFF_BLACK},
                                        {0}};
static const struct gn_choice clocks[] = {{"checked", 0}, {"trusted", 1}, {0}};
static const struct gn_choice idles[] = {
    {"none", GN_IDLE_NONE}, {"first", GN_IDLE_FIRST}, {"next", GN_IDLE_NEXT}, {0}};
static const struct gn_choice ranges[] = {
    {"auto", GN_RANGE_AUTO}, {"full", GN_RANGE_FULL}, {"limited", GN_RANGE_LIMITED}, {0}};
static const struct gn_choice consoles[] = {{"open", 0}, {"locked", 1}, {0}};
static const struct gn_choice turns[] = {{"0", 0}, {"90", 90}, {"180", 180}, {"270", 270}, {0}};

const struct gn_command_row gn_commands[GN_COMMAND_COUNT] = {
#define GN_COMMAND(ID, id, ...) [GN_COMMAND_##ID] = {__VA_ARGS__},
#include "options/command_rows.h"
#undef GN_COMMAND
};

const struct gn_option_row gn_option_rows[GN_OPTION_COUNT] = {
#define GN_OPTION(...) {__VA_ARGS__},
#include "options/rows.h"
};

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

bool gn_option_has_choice(const struct gn_option_row *row, const char *text) {
    for (const struct gn_choice *choice = row->choices; choice && choice->name; choice++)
        if (strcmp(choice->name, text) == 0) return true;
    return false;
}

const char *gn_option_key(const struct gn_option_row *row, char *buffer, size_t size) {
    snprintf(buffer, size, "%s", row->key ? row->key : row->name);
    for (char *c = buffer; *c; c++)
        if (*c == '-') *c = '_';
    return buffer;
}

bool gn_option_is_of(const struct gn_option_row *row, const char *section) {
    return row->section && strcmp(row->section, section) == 0;
}

const struct gn_option_row *gn_option_find_key(const char *section, const char *key) {
    char buffer[64];
    for (const struct gn_option_row *row = gn_option_rows; row < end_of_rows(); row++)
        if (gn_option_is_of(row, section) &&
            strcmp(gn_option_key(row, buffer, sizeof buffer), key) == 0)
            return row;
    return NULL;
}
