#include "kiosk/info_page.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/utsname.h>

#include "core/clock.h"
#include "core/health.h"
#include "core/text.h"
#include <config.h> /* the generated one */

enum { ADDRESSES_MAX = 4 };

#define ADD_LINE(page, ...) gn_text_add_line((page)->text, sizeof(page)->text, "\n", __VA_ARGS__)

static void add_screen(struct gn_info_page *page, const struct gn_screen *screen, int64_t now_ns) {
    const struct gn_screen_counts *c = &screen->counts;
    const bool again = page->made && c->shown >= page->shown && now_ns > page->made_ns;
    if (again)
        ADD_LINE(page, "Frames: %.1f a second, %llu missed",
                 (double)(c->shown - page->shown) / ((double)(now_ns - page->made_ns) * 1e-9),
                 (unsigned long long)c->missed);
    else
        ADD_LINE(page, "Frames: %llu missed", (unsigned long long)c->missed);
    page->shown = c->shown;
    if (screen->what[0])
        ADD_LINE(page, "Screen: %s", screen->what);
    else
        ADD_LINE(page, "Screen: %ux%u", screen->width_px, screen->height_px);
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
        ADD_LINE(page, "Address: %s (%s)", text, i->ifa_name);
        count++;
    }
    freeifaddrs(all);
    if (count == 0) ADD_LINE(page, "Address: none");
}

bool gn_info_page_step(struct gn_info_page *page, const struct gn_info *info, int64_t now_ns) {
    struct utsname system;
    if (page->made && now_ns - page->made_ns < GN_NS_PER_S) return false;
    page->text[0] = '\0';
    ADD_LINE(page, "gnomon %s", GN_VERSION);
    if (info->mode) ADD_LINE(page, "Mode: %.60s", info->mode);
    if (info->scene) ADD_LINE(page, "Scene: %.200s", info->scene);
    if (info->missing && info->missing[0]) ADD_LINE(page, "Shown without: %.200s", info->missing);
    if (info->screen) add_screen(page, info->screen, now_ns);
    if (info->caps) {
        ADD_LINE(page, "GPU: %s", info->caps->renderer);
        ADD_LINE(page, "Driver: %s", info->caps->version);
    }
    add_addresses(page);
    if (uname(&system) == 0)
        ADD_LINE(page, "System: %s %s %s", system.sysname, system.release, system.machine);
    const int hottest_mc = gn_health_read_hottest_mc(info->root ? info->root : "");
    if (hottest_mc > 0) ADD_LINE(page, "Temperature: %.0f C", hottest_mc * 1e-3);
    if (info->board && info->board[0]) ADD_LINE(page, "Board: %s", info->board);
    const long long s = info->uptime_ns / GN_NS_PER_S, days = s / 86400;
    if (days > 0)
        ADD_LINE(page, "Running: %lld day%s %02lld:%02lld:%02lld", days, days == 1 ? "" : "s",
                 s / 3600 % 24, s / 60 % 60, s % 60);
    else if (info->uptime_ns > 0)
        ADD_LINE(page, "Running: %02lld:%02lld:%02lld", s / 3600, s / 60 % 60, s % 60);
    page->made_ns = now_ns;
    page->made = true;
    return true;
}
