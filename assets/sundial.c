/* The default scene: the dial in the middle, what tests shadows around it, a landscape behind. */
#include "garden.h"
#include "glb.h"

static void add_look(struct gn_garden *g) {
    gn_glb_scene_extras(g->glb,
                        "{\"gnomon_sky\":[0.19,0.23,0.29],\"gnomon_ground\":[0.12,0.1,0.075],"
                        "\"gnomon_background\":[0.3,0.5,0.78]}");
}

static void add_cameras(struct gn_garden *g) {
    const float far = 1000; /* the landscape */
    gn_garden_add_view(
        g,
        &(struct gn_glb_camera){
            .name = "Garden", .aspect = .95f, .yfov = 40 * GN_RADIANS, .znear = .1f, .zfar = far},
        (float[3]){3.1f, 3.0f, 6.95f}, (float[3]){0, 1.48f, 0});
    gn_garden_add_view(
        g,
        &(struct gn_glb_camera){
            .name = "Dial", .aspect = 1.2f, .yfov = 40 * GN_RADIANS, .znear = .05f, .zfar = far},
        (float[3]){1.85f, 3.55f, 2.15f}, (float[3]){.12f, 1.3f, -.1f});
    gn_garden_add_view(g,
                       &(struct gn_glb_camera){
                           .name = "Top", .xmag = 8.6f, .ymag = 8.6f, .znear = .1f, .zfar = 40},
                       (float[3]){0, 20, 0}, (float[3]){0, 0, 0});
}

static void add_court(struct gn_garden *g) {
    struct gn_shape court = gn_garden_begin(COURT);
    gn_shape_paving(&court, 1.4f, 7.1f, 10, 48);
    gn_garden_stand(g, "Court", gn_garden_mesh(g, "court", &court, COURT), (struct gn_place){0},
                    "{\"gnomon_plane\":true,\"gnomon_cast\":false}");
}

const struct gn_garden_plan gn_sundial = {
    .parts = {add_look,
              add_cameras,
              gn_garden_add_lights,
              add_court,
              gn_garden_add_landscape,
              gn_garden_add_wall,
              gn_garden_add_hedge,
              gn_garden_add_gate,
              gn_garden_add_plinth,
              gn_garden_add_dial,
              gn_garden_add_portico,
              gn_garden_add_bench,
              gn_garden_add_urns,
              gn_garden_add_globe,
              gn_garden_add_armillary,
              gn_garden_add_arches,
              gn_garden_add_screen,
              gn_garden_add_trees,
              gn_garden_add_cypresses,
              gn_garden_add_hoop,
              gn_garden_add_gull,
              gn_garden_add_lamp_post,
              NULL},
    .tints = {{LAWN, {.145f, .235f, .06f, 1}, 0, 1, GRASS},
              {BRONZE, {.40f, .265f, .10f, 1}, 1, .3f, NO_PICTURE},
              {GLASS, {.05f, .34f, .44f, .58f}, 0, .12f, NO_PICTURE},
              {LEAVES, {.38f, .50f, .24f, 1}, 0, .9f, BRANCH},
              {HEDGE, {.15f, .25f, .07f, 1}, 0, 1, BUSH}},
    .lamp = {3.3f, 2.62f, -2.9f, 20},
    .slide = {2.75f, 0, -1.0f},
    .columns = {{-5.64f, 0, -7.77f, 126},
                {-7.13f, 0, -6.42f, 138},
                {-8.31f, 0, -4.8f, 150},
                {-9.13f, 0, -2.97f, 162}},
    .column_scale = 1.3f,
    .hoop = {2.85f, 1.3f, -5.5f, 0},
    .globe = {-2.1f, 0, 3.0f, 0},
    .armillary = {-1.2f, 0, -5.0f, 0},
    .arches = {2.85f, 0, -5.5f, -27},
    .bench = {4.5f, 0, -4.1f, -44},
    .screen = {-4.9f, 0, -.3f, -87},
    .urns = {{1.1f, 0, -5.4f, 10}, {5.55f, 0, -.55f, 30}},
    .trees = {{-8.3f, 0, 5.0f, 0}, {6.0f, 0, -8.2f, 100}, {-10.6f, 0, -2.6f, 220}},
    .cypresses = {{-9.4f, -6.6f, 1},
                  {1.2f, -11.2f, 1.15f},
                  {3.2f, -12.3f, .9f},
                  {11.0f, -6.0f, 1.05f},
                  {-8.6f, -9.6f, 1.2f},
                  {-3.4f, 10.2f, .95f},
                  {4.6f, 9.9f, 1}},
    .lap = .555f,
    .vista = true,
};
