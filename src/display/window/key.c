#include "display/window/key.h"

/* GLFW's numbers are constant across versions (glfw3.h); printable keys have the code of their US
 * layout character. */
static const struct {
    uint16_t from, to, first; /* from..to map to first, first + 1, .. */
} ranges[] = {
    {32, 32, 57},    {39, 39, 40},    {44, 44, 51},    {45, 45, 12},    {46, 46, 52},
    {47, 47, 53},    {48, 48, 11},    {49, 57, 2},     {59, 59, 39},    {61, 61, 13},
    {91, 91, 26},    {92, 92, 43},    {93, 93, 27},    {96, 96, 41},    {257, 257, 28},
    {258, 258, 15},  {259, 259, 14},  {260, 260, 110}, {261, 261, 111}, {262, 262, 106},
    {263, 263, 105}, {264, 264, 108}, {265, 265, 103}, {266, 266, 104}, {267, 267, 109},
    {269, 269, 107}, {280, 280, 58},  {283, 283, 99},  {284, 284, 119}, {290, 299, 59},
    {301, 301, 88},  {302, 313, 183}, {320, 320, 82},  {321, 323, 79},  {324, 326, 75},
    {327, 329, 71},  {330, 330, 83},  {331, 331, 98},  {332, 332, 55},  {333, 333, 74},
    {334, 334, 78},  {335, 335, 96},  {340, 340, 42},  {341, 341, 29},  {342, 342, 56},
    {344, 344, 54},  {345, 345, 97},  {346, 346, 100}, {348, 348, 139},
};

unsigned gn_window_key(int glfw) {
    /* A to Z; Q belongs to the window */
    static const uint8_t letters[26] = {30, 48, 46, 32, 18, 33, 34, 35, 23, 36, 37, 38, 50,
                                        49, 24, 25, 0,  19, 31, 20, 22, 47, 17, 45, 21, 44};
    if (glfw >= 'A' && glfw <= 'Z') return letters[glfw - 'A'];
    for (unsigned i = 0; i < sizeof ranges / sizeof ranges[0]; i++)
        if (glfw >= ranges[i].from && glfw <= ranges[i].to)
            return ranges[i].first + (unsigned)glfw - ranges[i].from;
    return GN_KEY_NONE;
}
