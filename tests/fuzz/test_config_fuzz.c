/* A configuration file spoilt at random: it is taken, or refused by one line that begins with the
 * file and a line of it. The seed is printed; GN_SEED=N repeats it. */
#include "unit/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/clock.h"
#include "options/file.h"

static const char good[] =
    "[display]\nconnector = HDMI-A-1\nmode = 1920x1080@60\nrotate = 90\n"
    "[scene]\nfile = a.glb\ncamera = Top\nturntable = 6\n"
    "[render]\nshadow = pcf\nmap = 512\nexposure = auto\nlimit = nodes=9\n"
    "[kiosk]\nsocket = ctl\ncaptions = yes\ncaption_seconds = 2\n"
    "[mode \"Soft\"]\nshadow = pcss\n[mode \"Plan\"]\ncamera = Top\n"
    "[light \"Sun\"]\nshadow = pcss\nmap = 256\n"
    "[button \"next\"]\nline = GPIO17\nkeys = space right\nactive_high = no\nbias = pull-up\n"
    "hold_ms = 900\npress = next\nhold = mode Soft\n"
    "[button \"prev\"]\nline = label:rp1/27\nclick = prev\ndouble = pause\n"
    "[button \"both\"]\nchord = next prev\nchord_ms = 100\npress = info\n";
static char path[] = "/tmp/gnomon-config-XXXXXX";
static uint64_t random_state;

static uint32_t below(uint32_t n) { /* xorshift64*, Vigna 2014 */
    random_state ^= random_state >> 12;
    random_state ^= random_state << 25;
    random_state ^= random_state >> 27;
    return (uint32_t)(random_state * UINT64_C(2685821657736338717) >> 32) % n;
}

/* Bytes changed, taken away and doubled, lines moved to where they do not belong. */
static size_t spoil(char *text, size_t size, size_t room) {
    for (uint32_t i = 1 + below(5); i > 0 && size > 1; i--) {
        const size_t at = below((uint32_t)size), rest = size - at;
        size_t piece = 1 + below(below(2) ? 3 : 60);
        piece = piece < rest ? piece : rest;
        switch (below(4)) {
        case 0: text[at] = (char)below(256); break;
        case 1: text[at] = "[]=\"\n; #:0-"[below(11)]; break;
        case 2:
            memmove(text + at, text + at + piece, rest - piece);
            size -= piece;
            break;
        default:
            if (size + piece > room) break;
            memmove(text + at + piece, text + at, rest);
            memcpy(text + at, good + below((uint32_t)(sizeof good - piece)), piece);
            size += piece;
        }
    }
    return size;
}

/* Without fsync: it is read a moment later. */
static void write_file(const char *text, size_t size) {
    FILE *file = fopen(path, "we");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void a_spoilt_file_is_taken_or_names_its_line(void **state) {
    const int rounds = getenv("GN_FULL") ? 40000 : 4000;
    int taken = 0;
    (void)state;
    for (int round = 0; round < rounds; round++) {
        char text[4096];
        memcpy(text, good, sizeof good - 1);
        const size_t size = spoil(text, sizeof good - 1, sizeof text);
        struct gn_options options;
        struct gn_err err = {0};
        int line = 0;
        write_file(text, size);
        gn_options_init(&options, GN_COMMAND_SHOW);
        if (gn_config_load(&options, path, NULL, &err)) {
            gn_options_resolve(&options);
            taken++;
        } else {
            if (strncmp(err.text, path, strlen(path)) != 0 ||
                sscanf(err.text + strlen(path), ":%d: ", &line) != 1 || line < 1)
                fail_msg("\"%s\" does not name its line", err.text);
            assert_null(strchr(err.text, '\n'));
            assert_int_equal(err.status, GN_EXIT_USAGE);
        }
        gn_options_finish(&options);
    }
    printf("%d of %d were right all the same\n", taken, rounds);
    assert_in_range(taken, 1, rounds - 1);
}

int main(void) {
    const char *seed = getenv("GN_SEED");
    random_state = seed ? strtoull(seed, NULL, 10) : (uint64_t)gn_clock_monotonic_ns() | 1;
    printf("GN_SEED=%llu\n", (unsigned long long)random_state);
    fflush(stdout);
    const int fd = mkstemp(path);
    if (fd < 0) return 1;
    close(fd);
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_spoilt_file_is_taken_or_names_its_line)};
    const int failed = RUN(tests);
    unlink(path);
    return failed;
}
