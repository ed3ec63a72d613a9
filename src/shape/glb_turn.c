/* Rotations of glb.h. */
#include "shape/glb.h"

#include <math.h>

static void normalise(float v[3]) {
    float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++) v[i] /= length;
}

static void cross(const float a[3], const float b[3], float out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Quaternion of the rotation matrix with columns x, y, z; the largest component is computed first,
 * for precision. */
static void from_axes(const float x[3], const float y[3], const float z[3], float q[4]) {
    float square[4] = {1 + x[0] - y[1] - z[2], 1 - x[0] + y[1] - z[2], 1 - x[0] - y[1] + z[2],
                       1 + x[0] + y[1] + z[2]};
    float terms[4][4] = {
        {square[0], x[1] + y[0], x[2] + z[0], y[2] - z[1]},
        {x[1] + y[0], square[1], y[2] + z[1], z[0] - x[2]},
        {x[2] + z[0], y[2] + z[1], square[2], x[1] - y[0]},
        {y[2] - z[1], z[0] - x[2], x[1] - y[0], square[3]},
    };
    int big = 0;
    for (int i = 1; i < 4; i++)
        if (square[i] > square[big]) big = i;
    for (int i = 0; i < 4; i++) q[i] = terms[big][i] / (2 * sqrtf(square[big]));
}

void gn_glb_look(const float eye[3], const float target[3], float turn[4]) {
    float x[3], y[3], z[3] = {eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]};
    float up[3] = {0, 1, 0};
    normalise(z);
    if (fabsf(z[1]) > 0.9999f) up[1] = 0, up[2] = -1;
    cross(up, z, x);
    normalise(x);
    cross(z, x, y);
    from_axes(x, y, z, turn);
}

void gn_glb_turn_y(float degrees, float turn[4]) {
    double half = degrees * M_PI / 360;
    turn[0] = turn[2] = 0;
    turn[1] = (float)sin(half);
    turn[3] = (float)cos(half);
}
