#include "image/ball.h"

#include <math.h>
#include <stdio.h>

enum { AROUND = 64, DOWN = 32, POINTS = (AROUND + 1) * (DOWN + 1), TRIANGLES = 2 * AROUND * DOWN };

int gn_ball_add(struct gn_maker *maker, float radius_m) {
    static float places[POINTS][3], normals[POINTS][3];
    static uint16_t indices[TRIANGLES][3];
    const double pi = acos(-1), r = (double)radius_m;
    char box[100];
    for (int i = 0; i < POINTS; i++) {
        /* to the bit the same where the ends of a row, and the points of a pole, meet */
        const int row = i / (AROUND + 1);
        const double down = pi * row / DOWN, around = 2 * pi * (i % (AROUND + 1) % AROUND) / AROUND,
                     out = row % DOWN ? sin(down) : 0;
        normals[i][0] = (float)(out * cos(around));
        normals[i][1] = (float)cos(down);
        normals[i][2] = (float)(out * sin(around));
        for (int k = 0; k < 3; k++) places[i][k] = radius_m * normals[i][k];
    }
    for (int i = 0; i < AROUND * DOWN; i++) {
        const int a = i / AROUND * (AROUND + 1) + i % AROUND, b = a + AROUND + 1;
        const int six[6] = {a, a + 1, b, b, a + 1, b + 1};
        for (int k = 0; k < 6; k++) indices[2 * i + k / 3][k % 3] = (uint16_t)six[k];
    }
    snprintf(box, sizeof box, "'min':[%g,%g,%g],'max':[%g,%g,%g]", -r, -r, -r, r, r, r);
    const int first = gn_maker_accessor(maker, "VEC3", 5126, POINTS, places, sizeof places, box);
    gn_maker_accessor(maker, "VEC3", 5126, POINTS, normals, sizeof normals, NULL);
    gn_maker_accessor(maker, "SCALAR", 5123, (size_t)3 * TRIANGLES, indices, sizeof indices, NULL);
    return first;
}

bool gn_uniform_write(const char *path, int power) {
    FILE *file = fopen(path, "wb");
    if (!file) return false;
    fputs("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n", file);
    for (int i = 0; i < 8; i++)
        fwrite((uint8_t[]){128, 128, 128, (uint8_t)(129 + power)}, 4, 1, file);
    return fclose(file) == 0;
}
