/* This machine according to the kernel, and what this user may open: memory, groups, DRM cards
 * with their connectors, GPIO chips. Nothing is opened, all is read from /proc, /sys and the modes
 * of the device nodes. */
#ifndef GN_CLI_MACHINE_H
#define GN_CLI_MACHINE_H

#include <stdbool.h>
#include <stdint.h>

enum { GN_MACHINE_DEVICES = 32, GN_MACHINE_CONNECTORS = 16, GN_MACHINE_GROUPS = 48 };

enum gn_device_kind { GN_DEVICE_CARD, GN_DEVICE_RENDER, GN_DEVICE_GPIO };
struct gn_device {
    enum gn_device_kind kind;
    char path[64]; /* "/dev/dri/card0" */
    char
        driver[48]; /* of the kernel ("vc4"); of a GPIO chip the device it belongs to; "" unknown */
    char group[32]; /* that owns the node; its number where it has no name */
    bool group_may; /* that group may read and write */
    bool readable, writable; /* by this user */
    char holder[64]; /* CARD: the process that has it open, "Xorg (pid 612)"; "": none found */
};
struct gn_connector {
    char name[48];    /* "card0-HDMI-A-1" */
    char status[16];  /* "connected", "disconnected", "unknown" */
    char mode[24];    /* the preferred one, "1920x1080", or "" */
    char modes[200];  /* all sizes, the preferred one first, a space between two; cut */
    char monitor[12]; /* vendor and product of its EDID, "DEL 40f1"; "" without one */
};

struct gn_machine {
    char model[96];  /* of the board, by the device tree, else by DMI; "" without either */
    char cpu[64];    /* "AMD EPYC 7543"; "" where the kernel names none, as on most ARM boards */
    char system[96]; /* "Debian GNU/Linux 12 (bookworm)" */
    char kernel[96], arch[24];
    int cpus;
    uint64_t memory_mb, free_mb; /* 2^20 bytes; free: available without swapping */
    uint64_t cma_mb;             /* contiguous memory that a GPU without its own may use; 0: none */
    char user[48];
    char groups[GN_MACHINE_GROUPS][32];
    int group_count;
    struct gn_device devices[GN_MACHINE_DEVICES]; /* by kind, then by name */
    int device_count;
    struct gn_connector connectors[GN_MACHINE_CONNECTORS];
    int connector_count;
};

/* root is put before every path: "" except in tests. Missing values stay empty. */
void gn_machine_read(struct gn_machine *machine, const char *root);

#endif
