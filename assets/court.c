/* What stands in every court with the dial: its walls, the dial, the lamp post, and the lights. */
#include "dial.h"
#include "garden.h"
#include "glb.h"

#include <math.h>
#include <stdio.h>

static const struct gn_dial dial = {
    .latitude = GN_LATITUDE, .radius = 1.42f, .centre = 0.72f, .length = 0.92f, .thickness = 0.07f};
static const float DIAL_TOP = 1.245f;

void gn_garden_add_wall(struct gn_garden *g) {
    const float body[][2] = {{6.9f, -.05f}, {7.25f, -.05f}, {7.25f, .46f}, {6.9f, .46f}};
    const float coping[][2] = {{6.84f, .45f}, {7.31f, .45f}, {7.31f, .52f},
                               {7.24f, .57f}, {6.91f, .57f}, {6.84f, .52f}};
    struct gn_shape shape = gn_garden_begin(LIME), top = gn_garden_begin(STONE);
    gn_shape_arc(&shape, body, GN_COUNT(body), -36, 255, 42);
    gn_garden_put(g, "Wall", &shape, LIME);
    gn_shape_arc(&top, coping, GN_COUNT(coping), -36.4f, 255.4f, 42);
    gn_garden_put(g, "Coping", &top, STONE);
}

void gn_garden_add_hedge(struct gn_garden *g) {
    const float profile[][2] = {{7.75f, -.05f}, {8.75f, -.05f}, {8.8f, .9f}, {8.6f, 1.22f},
                                {8.25f, 1.32f}, {7.9f, 1.22f},  {7.7f, .9f}};
    struct gn_shape shape = gn_garden_begin(HEDGE);
    gn_shape_arc(&shape, profile, GN_COUNT(profile), -4, 222, 36);
    gn_garden_put(g, "Hedge", &shape, HEDGE);
}

void gn_garden_add_gate(struct gn_garden *g) {
    static const float profile[][2] = {{0, .87f}, {.14f, .87f}, {.1f, .93f}, {.1f, .96f}};
    struct gn_shape shape = gn_garden_begin(LIME);
    gn_shape_move(&shape, 0, -.05f, 0);
    gn_shape_block(&shape, .56f, .9f, .56f);
    gn_shape_move(&shape, 0, .85f, 0);
    gn_shape_block(&shape, .68f, .09f, .68f);
    gn_shape_home(&shape);
    gn_shape_lathe(&shape, profile, GN_COUNT(profile), 20);
    gn_shape_move(&shape, 0, 1.17f, 0);
    gn_shape_sphere(&shape, .24f, 24, 12);
    int mesh = gn_garden_mesh(g, "gatepost", &shape, LIME);
    const float angles[2] = {-38.2f, 257.2f};
    for (int i = 0; i < 2; i++) {
        struct gn_place at = {7.07f * cosf(angles[i] * GN_RADIANS), 0,
                              -7.07f * sinf(angles[i] * GN_RADIANS), angles[i]};
        gn_garden_stand(g, i ? "Gatepost W" : "Gatepost E", mesh, at, NULL);
    }
}

void gn_garden_add_plinth(struct gn_garden *g) {
    static const float profile[][2] = {
        {0, -.05f},     {2.2f, -.05f},  {2.2f, .14f},   {2.17f, .17f},  {1.84f, .17f},
        {1.84f, .32f},  {1.81f, .35f},  {1.36f, .35f},  {1.40f, .375f}, {1.42f, .41f},
        {1.40f, .445f}, {1.36f, .47f},  {1.28f, .47f},  {1.28f, .50f},  {1.21f, .54f},
        {1.165f, .61f}, {1.15f, .70f},  {1.165f, .80f}, {1.22f, .89f},  {1.28f, .93f},
        {1.28f, .96f},  {1.34f, .96f},  {1.43f, 1.0f},  {1.49f, 1.06f}, {1.52f, 1.11f},
        {1.52f, 1.16f}, {1.50f, 1.18f}, {0, 1.18f},
    };
    struct gn_shape shape = gn_garden_begin(STONE);
    gn_shape_lathe(&shape, profile, GN_COUNT(profile), 36);
    gn_garden_put(g, "Plinth", &shape, STONE);
}

void gn_garden_add_dial(struct gn_garden *g) {
    static const float profile[][2] = {
        {0, 1.17f}, {1.42f, 1.17f}, {1.44f, 1.19f}, {1.44f, 1.225f}, {1.42f, 1.245f}};
    struct gn_shape plate = gn_garden_begin(MARBLE), inlay = gn_garden_begin(INLAY),
                    gnomon = gn_garden_begin(BRONZE);
    gn_shape_lathe(&plate, profile, GN_COUNT(profile), 48);
    gn_shape_at(&plate, 0, DIAL_TOP, 0);
    gn_shape_ring(&plate, .02f, 1.42f, 48);
    gn_garden_put(g, "Dial plate", &plate, MARBLE);
    gn_shape_at(&inlay, 0, DIAL_TOP, 0);
    gn_dial_inlay(&inlay, &dial);
    gn_garden_put(g, "Hours", &inlay, INLAY);
    gn_shape_at(&gnomon, 0, DIAL_TOP, 0);
    gn_dial_gnomon(&gnomon, &dial);
    gn_garden_put(g, "Gnomon", &gnomon, BRONZE);
}

void gn_garden_add_lamp_post(struct gn_garden *g) {
    const struct gn_place at = g->plan->lamp;
    static const float foot[][2] = {{0, -.05f},   {.17f, -.05f}, {.17f, .1f}, {.09f, .2f},
                                    {.055f, .5f}, {.04f, 3.0f},  {0, 3.05f}};
    static const float roof[][2] = {{0, .26f}, {.24f, .24f}, {.13f, .36f}, {.05f, .42f}, {0, .5f}};
    static const float box[][2] = {{.10f, -.06f}, {.17f, .25f}};
    struct gn_shape iron = gn_garden_begin(IRON), pane = gn_garden_begin(PANE),
                    flame = gn_garden_begin(GLOW);
    gn_shape_at(&iron, .62f, -at.y, 0);
    gn_shape_lathe(&iron, foot, GN_COUNT(foot), 14);
    gn_shape_home(&iron);
    const float arm[][3] = {
        {.62f, .2f, 0}, {.5f, .48f, 0}, {.28f, .6f, 0}, {.08f, .58f, 0}, {0, .46f, 0}};
    gn_shape_tube(&iron, arm, GN_COUNT(arm), .022f, 6);
    gn_shape_lathe(&iron, roof, GN_COUNT(roof), 6);
    gn_shape_lathe(&pane, box, GN_COUNT(box), 6);
    gn_shape_at(&flame, 0, .12f, 0);
    gn_shape_sphere(&flame, .06f, 12, 8);
    gn_garden_stand(g, "Lamp post", gn_garden_mesh(g, "lamp post", &iron, IRON), at, NULL);
    gn_garden_stand(g, "Lamp panes", gn_garden_mesh(g, "lamp panes", &pane, PANE), at,
                    "{\"gnomon_cast\":false}");
    gn_garden_stand(g, "Flame", gn_garden_mesh(g, "flame", &flame, GLOW), at,
                    "{\"gnomon_cast\":false}");
}

void gn_garden_add_lights(struct gn_garden *g) {
    const struct gn_place lamp = g->plan->lamp;
    struct gn_glb_light sun = {
        .name = "Sun", .kind = GN_GLB_DIRECTIONAL, .rgb = {1, .93f, .80f}, .intensity = 3.0f};
    struct gn_glb_node node = {.name = "Sun"};
    gn_dial_sun(&dial, 15.5f, 15, node.move);
    for (int i = 0; i < 3; i++) node.move[i] *= 20;
    gn_glb_look(node.move, (float[3]){0}, node.turn);
    node.light = gn_glb_light(g->glb, &sun);
    gn_glb_node(g->glb, &node);

    char slide[160]; /* a leaded window, 10 cm in front of the flame */
    snprintf(slide, sizeof slide,
             "{\"gnomon_slide\":%d,\"gnomon_slide_size_m\":[0.084,0.126],"
             "\"gnomon_slide_distance_m\":0.13,\"gnomon_slide_outside\":\"dark\"}",
             g->pictures[WINDOW] - 1);
    struct gn_glb_light spot = {.name = "Lantern",
                                .kind = GN_GLB_SPOT,
                                .rgb = {1, .62f, .3f},
                                .intensity = 60,
                                .range = 14,
                                .inner = 36 * GN_RADIANS,
                                .outer = 46 * GN_RADIANS,
                                .extras = slide};
    struct gn_glb_node hung = {.name = "Lantern", .move = {lamp.x, lamp.y - .08f, lamp.z}};
    gn_glb_look(hung.move, g->plan->slide, hung.turn);
    hung.light = gn_glb_light(g->glb, &spot);
    gn_glb_node(g->glb, &hung);
}

void gn_garden_add_view(struct gn_garden *g, const struct gn_glb_camera *lens, const float eye[3],
                        const float target[3]) {
    struct gn_glb_node node = {.name = lens->name,
                               .camera = gn_glb_camera(g->glb, lens),
                               .move = {eye[0], eye[1], eye[2]}};
    gn_glb_look(eye, target, node.turn);
    gn_glb_node(g->glb, &node);
}
