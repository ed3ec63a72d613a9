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

static void add_speed(struct gn_info_page *page, const struct gn_screen *screen, int64_t now_ns) {
    const struct gn_screen_counts *c = &screen->counts;
    const uint64_t all = c->shown + c->missed;
    const double late = all ? 100.0 * (double)c->missed / (double)all : 0.0;
    const bool again = page->made && c->shown >= page->shown && now_ns > page->made_ns;
    if (again)
        ADD_LINE(page, "Speed\t%.0f frames/s, %.1f %% late",
                 (double)(c->shown - page->shown) / ((double)(now_ns - page->made_ns) * 1e-9),
                 late);
    else
        ADD_LINE(page, "Speed\t%.1f %% late", late);
    page->shown = c->shown;
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
        ADD_LINE(page, "Address\t%s (%s)", text, i->ifa_name);
        count++;
    }
    freeifaddrs(all);
    if (count == 0) ADD_LINE(page, "Address\tnone");
}

static void add_problem(struct gn_info_page *page, const struct gn_info *info) {
    const bool shows = info->shown && info->shown[0];
    ADD_LINE(page, "%s", info->problem ? info->problem->title : "Running well");
    if (info->problem && shows) ADD_LINE(page, "Problem\t%s", info->shown);
    if (info->problem) ADD_LINE(page, "What to do\t%s", info->problem->advice);
}

static void add_running(struct gn_info_page *page, int64_t uptime_ns) {
    const long long s = uptime_ns / GN_NS_PER_S, days = s / 86400;
    if (days > 0)
        ADD_LINE(page, "Running for\t%lld day%s %02lld:%02lld:%02lld", days, days == 1 ? "" : "s",
                 s / 3600 % 24, s / 60 % 60, s % 60);
    else if (uptime_ns > 0)
        ADD_LINE(page, "Running for\t%02lld:%02lld:%02lld", s / 3600, s / 60 % 60, s % 60);
}

bool gn_info_page_step(struct gn_info_page *page, const struct gn_info *info, int64_t now_ns) {
    struct utsname system;
    const struct gn_screen *screen = info->screen;
    if (page->made && now_ns - page->made_ns < GN_NS_PER_S) return false;
    page->text[0] = '\0';
    add_problem(page, info);
    if (info->board && info->board[0]) ADD_LINE(page, "Board\t%s", info->board);
    if (info->scene) ADD_LINE(page, "Scene\t%.200s", info->scene);
    if (info->missing && info->missing[0]) ADD_LINE(page, "Shown without\t%.200s", info->missing);
    if (info->mode) ADD_LINE(page, "Mode\t%.60s", info->mode);
    if (info->sun && info->sun[0]) ADD_LINE(page, "Sun\t%s", info->sun);
    if (screen && screen->what[0])
        ADD_LINE(page, "Screen\t%s", screen->what);
    else if (screen)
        ADD_LINE(page, "Screen\t%ux%u", screen->width_px, screen->height_px);
    if (screen) add_speed(page, screen, now_ns);
    add_addresses(page);
    const int hottest_mc = gn_health_read_hottest_mc(info->root ? info->root : "");
    if (hottest_mc > 0) ADD_LINE(page, "Temperature\t%.0f C", hottest_mc * 1e-3);
    add_running(page, info->uptime_ns);
    if (info->caps) {
        ADD_LINE(page, "GPU\t%s", info->caps->renderer);
        ADD_LINE(page, "Driver\t%s", info->caps->version);
    }
    if (uname(&system) == 0)
        ADD_LINE(page, "System\t%s %s %s", system.sysname, system.release, system.machine);
    ADD_LINE(page, "Program\tgnomon %s", GN_VERSION);
    page->made_ns = now_ns;
    page->made = true;
    return true;
}
