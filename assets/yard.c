/* The scene of tests and measurements: the default scene up to 0.2. It does not change, so that
 * figures stay comparable. */
#include "garden.h"
#include "glb.h"

static void add_look(struct gn_garden *g) {
    gn_glb_scene_extras(g->glb,
                        "{\"gnomon_sky\":[0.19,0.23,0.29],\"gnomon_ground\":[0.12,0.1,0.075],"
                        "\"gnomon_background\":[0.5,0.66,0.84]}");
}

/* Ground layers do not cast: as casters they would only enlarge the extent of every shadow map. */
static void add_ground(struct gn_garden *g) {
    struct gn_shape court = gn_garden_begin(COURT), lawn = gn_garden_begin(LAWN);
    gn_shape_paving(&court, 1.4f, 7.1f, 10, 48);
    gn_garden_stand(g, "Court", gn_garden_mesh(g, "court", &court, COURT), (struct gn_place){0},
                    "{\"gnomon_plane\":true,\"gnomon_cast\":false}");
    gn_shape_at(&lawn, 0, -0.02f, 0);
    gn_shape_ring(&lawn, 7.0f, 60, 48);
    gn_garden_stand(g, "Lawn", gn_garden_mesh(g, "lawn", &lawn, LAWN), (struct gn_place){0},
                    "{\"gnomon_cast\":false}");
}

static void add_cameras(struct gn_garden *g) {
    gn_garden_add_view(g,
                       &(struct gn_glb_camera){
                           .name = "Garden", .yfov = 34 * GN_RADIANS, .znear = .1f, .zfar = 100},
                       (float[3]){3.9f, 5.2f, 10.2f}, (float[3]){.2f, .95f, -.35f});
    gn_garden_add_view(g,
                       &(struct gn_glb_camera){
                           .name = "Dial", .yfov = 40 * GN_RADIANS, .znear = .05f, .zfar = 100},
                       (float[3]){1.85f, 3.55f, 2.15f}, (float[3]){.12f, 1.3f, -.1f});
    gn_garden_add_view(
        g,
        &(struct gn_glb_camera){
            .name = "Top", .xmag = 8.6f * 16 / 9, .ymag = 8.6f, .znear = .1f, .zfar = 40},
        (float[3]){0, 20, 0}, (float[3]){0, 0, 0});
}

const struct gn_garden_plan gn_yard = {
    .parts = {add_look,
              add_cameras,
              gn_garden_add_lights,
              add_ground,
              gn_garden_add_wall,
              gn_garden_add_hedge,
              gn_garden_add_gate,
              gn_garden_add_plinth,
              gn_garden_add_dial,
              gn_garden_add_portico,
              gn_garden_add_bench,
              gn_garden_add_urns,
              gn_garden_add_balls,
              gn_garden_add_globe,
              gn_garden_add_armillary,
              gn_garden_add_arches,
              gn_garden_add_canes,
              gn_garden_add_fence,
              gn_garden_add_screen,
              gn_garden_add_trees,
              gn_garden_add_cypresses,
              gn_garden_add_hoop,
              gn_garden_add_gull,
              gn_garden_add_lamp_post,
              NULL},
    .lamp = {4.15f, 2.62f, -2.35f, 20},
    .slide = {3.05f, 0, -1.2f},
    .columns = {{-4.30f, 0, -3.55f, -30},
                {-5.25f, 0, -1.85f, -18},
                {-5.55f, 0, .05f, -6},
                {-5.2f, 0, 1.95f, 6}},
    .hoop = {-5.4f, 1.66f, -.9f, 0},
    .globe = {-.35f, 0, 4.35f, 0},
    .armillary = {4.6f, 0, 1.6f, 0},
    .arches = {2.55f, 0, -5.0f, -30},
    .bench = {4.5f, 0, -4.1f, -44},
    .screen = {-2.45f, 0, 3.85f, 72},
    .urns = {{1.1f, 0, -5.4f, 10}, {5.55f, 0, -.55f, 30}},
    .trees = {{-8.3f, 0, 5.0f, 0}, {6.9f, 0, -7.4f, 100}, {-3.9f, 0, -9.6f, 220}},
    .cypresses = {{-8.2f, -9.5f, 1},
                  {1.2f, -11.2f, 1.15f},
                  {3.2f, -12.3f, .9f},
                  {11.0f, -6.0f, 1.05f},
                  {-11.5f, -4.5f, 1.2f}},
    .lap = .2f,
};
