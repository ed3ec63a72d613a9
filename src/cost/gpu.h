/* GPUs of boards whose time is estimated (--for), and how much each does in a second. No GL. */
#ifndef GN_COST_GPU_H
#define GN_COST_GPU_H

/* X(NAME, name, board and GPU, instructions, fetches, bytes, error, what the figures are from).
 *
 * Instructions and fetches: billions of lanes a second, each lane one instruction or one filtered
 * texel. Bytes: billions a second that the GPU gets of its memory: half of the memory's peak, since
 * display and processors share it and no access pattern reaches it; nowhere measured. Error: share
 * by which a public measurement differs from the figures; 0: there is none, and what is computed
 * by them is not calibrated. Instructions are as Mesa's compilers count them: of V3D a QPU's, which
 * adds and multiplies in one; of Bifrost each half of a tuple; of Valhall and Adreno one operation.
 *
 * Measured: glmark2 effect2d with a kernel of 5x3 at 800x600, 15 fetches and 15 x 480,000 in 2.58
 * ms on a Pi 5 are 2.79 G fetches a second, 3 % under 3 texture units at .96 GHz. The same unit is
 * in the Pi 4, where two of them have .5 GHz. */
/* clang-format off */
#define GN_COST_GPUS(X) \
    X(PI4, "pi4", "Raspberry Pi 4, V3D 4.2", 16.0, 1.0, 6.4, 0.03, "8 QPUs of 4 lanes and 2 texture units at .5 GHz, LPDDR4-3200 x 32") \
    X(PI5, "pi5", "Raspberry Pi 5, V3D 7.1", 46.1, 2.88, 8.5, 0.03, "12 QPUs of 4 lanes and 3 texture units at .96 GHz, LPDDR4X-4267 x 32") \
    X(G31, "g31", "Amlogic S905X3, Mali-G31 of two pixels", 10.4, 1.3, 5.3, 0, "2 engines of 4 lanes, 2 instructions and 2 texels a clock at .65 GHz, DDR4-2666 x 32") \
    X(G52, "g52", "RK3566 and RK3568, Mali-G52 of one core", 25.6, 1.6, 4.2, 0, "2 engines of 8 lanes, 2 instructions and 2 texels a clock at .8 GHz, LPDDR4-2112 x 32") \
    X(G610, "g610", "RK3588, Mali-G610 of four cores", 256.0, 16.0, 16.9, 0, "4 cores of 64 lanes and 4 texels a clock at 1 GHz, LPDDR4X-4224 x 64") \
    X(A618, "a618", "Snapdragon 7c, Adreno 618", 105.6, 6.6, 8.5, 0, "128 lanes and 8 texels a clock at .825 GHz, LPDDR4X-4266 x 32") \
    X(A660, "a660", "QCS6490, Adreno 643 (as a660)", 208.0, 13.0, 12.8, 0, "256 lanes and 16 texels a clock at .812 GHz, LPDDR4X-3200 x 64")
/* clang-format on */

enum gn_cost_gpu_id {
#define X(NAME, ...) GN_COST_##NAME,
    GN_COST_GPUS(X)
#undef X
        GN_COST_GPU_COUNT,
};
struct gn_cost_gpu {
    const char *name, *what;
    double instructions_g, fetches_g, bytes_g, error;
    const char *source;
};
extern const struct gn_cost_gpu gn_cost_gpus[GN_COST_GPU_COUNT];
/* The one that calls itself so (GL_RENDERER), if its figures are calibrated: those of V3D, which
 * boards have in one size only. NULL: any other. */
const struct gn_cost_gpu *gn_cost_gpu_of(const char *renderer);

#endif
