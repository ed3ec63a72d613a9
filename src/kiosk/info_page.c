#include "kiosk/info_page.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

#include "core/clock.h"
#include <config.h> /* the generated one */

enum { ADDRESSES_MAX = 4, ZONES_MAX = 16 };

/* Adds a line; one that does not fit is left out. */
__attribute__((format(printf, 2, 3))) static void add_line(struct gn_info_page *page,
                                                           const char *format, ...) {
    const size_t used = strlen(page->text), room = sizeof page->text - used;
    va_list args;
    va_start(args, format);
    const int length = vsnprintf(page->text + used, room, format, args);
    va_end(args);
    const bool fits = length >= 0 && (size_t)length + 1 < room;
    if (fits) page->text[used + (size_t)length] = '\n';
    page->text[fits ? used + (size_t)length + 1 : used] = '\0';
}

static void add_screen(struct gn_info_page *page, const struct gn_screen *screen, int64_t now_ns) {
    const struct gn_screen_counts *c = &screen->counts;
    const bool again = page->made && c->shown >= page->shown && now_ns > page->made_ns;
    if (again)
        add_line(page, "Frames: %.1f a second, %llu missed",
                 (double)(c->shown - page->shown) / ((double)(now_ns - page->made_ns) * 1e-9),
                 (unsigned long long)c->missed);
    else
        add_line(page, "Frames: %llu missed", (unsigned long long)c->missed);
    page->shown = c->shown;
    if (screen->what[0])
        add_line(page, "Screen: %s", screen->what);
    else
        add_line(page, "Screen: %ux%u", screen->width_px, screen->height_px);
}

static void add_addresses(struct gn_info_page *page) {
    struct ifaddrs *all = NULL;
    char text[INET6_ADDRSTRLEN];
    int count = 0;
    if (getifaddrs(&all) != 0) return;
    for (const struct ifaddrs *i = all; i && count < ADDRESSES_MAX; i = i->ifa_next) {
        const struct sockaddr *address = i->ifa_addr;
        const void *number = NULL;
        if (!address || !(i->ifa_flags & IFF_UP) || i->ifa_flags & IFF_LOOPBACK) continue;
        if (address->sa_family == AF_INET)
            number = &((const struct sockaddr_in *)address)->sin_addr;
        if (address->sa_family == AF_INET6)
            number = &((const struct sockaddr_in6 *)address)->sin6_addr;
        if (!number || (address->sa_family == AF_INET6 && IN6_IS_ADDR_LINKLOCAL(number)) ||
            !inet_ntop(address->sa_family, number, text, sizeof text))
            continue;
        add_line(page, "Address: %s (%s)", text, i->ifa_name);
        count++;
    }
    freeifaddrs(all);
    if (count == 0) add_line(page, "Address: none");
}

/* The hottest of the kernel's thermal zones. */
static void add_temperature(struct gn_info_page *page, const char *root) {
    long hottest = 0; /* thousandths of a degree */
    for (int zone = 0; zone < ZONES_MAX; zone++) {
        char path[256], text[32] = "";
        snprintf(path, sizeof path, "%s/sys/class/thermal/thermal_zone%d/temp", root ? root : "",
                 zone);
        FILE *file = fopen(path, "re");
        if (!file) continue;
        if (fgets(text, sizeof text, file) && strtol(text, NULL, 10) > hottest)
            hottest = strtol(text, NULL, 10);
        fclose(file);
    }
    if (hottest > 0) add_line(page, "Temperature: %.0f C", (double)hottest * 1e-3);
}

bool gn_info_page_step(struct gn_info_page *page, const struct gn_info *info, int64_t now_ns) {
    struct utsname system;
    if (page->made && now_ns - page->made_ns < GN_NS_PER_S) return false;
    page->text[0] = '\0';
    add_line(page, "gnomon %s", GN_VERSION);
    if (info->mode) add_line(page, "Mode: %.60s", info->mode);
    if (info->scene) add_line(page, "Scene: %.200s", info->scene);
    if (info->missing && info->missing[0]) add_line(page, "Shown without: %.200s", info->missing);
    if (info->screen) add_screen(page, info->screen, now_ns);
    if (info->caps) {
        add_line(page, "GPU: %s", info->caps->renderer);
        add_line(page, "Driver: %s", info->caps->version);
    }
    add_addresses(page);
    if (uname(&system) == 0)
        add_line(page, "System: %s %s %s", system.sysname, system.release, system.machine);
    add_temperature(page, info->root);
    if (info->board && info->board[0]) add_line(page, "Board: %s", info->board);
    const long long s = info->uptime_ns / GN_NS_PER_S, days = s / 86400;
    if (days > 0)
        add_line(page, "Running: %lld day%s %02lld:%02lld:%02lld", days, days == 1 ? "" : "s",
                 s / 3600 % 24, s / 60 % 60, s % 60);
    else if (info->uptime_ns > 0)
        add_line(page, "Running: %02lld:%02lld:%02lld", s / 3600, s / 60 % 60, s % 60);
    page->made_ns = now_ns;
    page->made = true;
    return true;
}
