/* Windows of a lattice, laid in its pages: what must hold wherever they lie. */
#include "shadow/pages.h"

#include <math.h>
#include <string.h>

#include "unit/check.h"

enum { MOST_PX = 40 };

static struct gn_shadow_drawn lay(double anchor_x, double anchor_y, double x, double y,
                                  uint32_t width, uint32_t height, uint32_t map_px) {
    struct gn_shadow_drawn layout;
    gn_pages_lay((double[2]){anchor_x, anchor_y}, (double[2]){x, y},
                 (double[2]){x + width - 1, y + height - 1}, map_px, &layout);
    return layout;
}

/* Marks a rectangle of a target; nothing of it was marked. */
static void mark(bool marks[MOST_PX][MOST_PX], const uint32_t at[2], const uint32_t size[2],
                 uint32_t map_px) {
    for (int k = 0; k < 2; k++) assert_true(size[k] > 0 && at[k] + size[k] <= map_px);
    for (uint32_t y = at[1]; y < at[1] + size[1]; y++)
        for (uint32_t x = at[0]; x < at[0] + size[0]; x++) {
            assert_false(marks[y][x]);
            marks[y][x] = true;
        }
}

static void expect_whole(const struct gn_shadow_drawn *layout, const double anchor[2],
                         const double first[2], const uint32_t size[2], uint32_t map_px) {
    bool pages[MOST_PX][MOST_PX] = {{false}}, map[MOST_PX][MOST_PX] = {{false}};
    uint64_t area = 0;
    for (int k = 0; k < 2; k++) { /* all of the window, and the map's edge free */
        assert_true(layout->corner_texels[k] + layout->px[k] == first[k]);
        assert_int_equal(layout->size_px[k], size[k]);
        assert_true(layout->px[k] >= 1 && layout->px[k] + size[k] < map_px);
    }
    assert_in_range(layout->page_count, 1, GN_SHADOW_PAGES_MAX);
    for (uint32_t p = 0; p < layout->page_count; p++) {
        const struct gn_shadow_page *page = &layout->pages[p];
        for (int k = 0; k < 2; k++) {
            assert_true(fmod(page->corner[k] - anchor[k], map_px) == 0);
            assert_true(page->corner[k] + page->from_px[k] ==
                        layout->corner_texels[k] + page->to_px[k]);
            assert_true(page->to_px[k] >= layout->px[k] &&
                        page->to_px[k] + page->size_px[k] <= layout->px[k] + layout->size_px[k]);
        }
        mark(pages, page->from_px, page->size_px, map_px); /* one target holds all */
        mark(map, page->to_px, page->size_px, map_px);
        area += (uint64_t)page->size_px[0] * page->size_px[1];
    }
    assert_int_equal(area, (uint64_t)size[0] * size[1]);
}

/* Every place that a window can have in three pages, below 0 and above, of every width. */
static void test_pages_hold_all_of_a_window_once(void **state) {
    (void)state;
    int paged = 0, straight = 0;
    for (uint32_t map_px = 3; map_px < 12; map_px++)
        for (uint32_t size = 1; size + 2 <= map_px; size++)
            for (int x = -2 * (int)map_px; x < (int)map_px; x++)
                for (int y = -1; y < (int)map_px; y++) {
                    const double anchor[2] = {-3, 2}, first[2] = {x, y};
                    const uint32_t sizes[2] = {size, 1 + (size + 3) % (map_px - 2)};
                    struct gn_shadow_drawn layout =
                        lay(anchor[0], anchor[1], x, y, sizes[0], sizes[1], map_px);
                    expect_whole(&layout, anchor, first, sizes, map_px);
                    *(layout.paged ? &paged : &straight) += 1;
                }
    assert_true(paged > 1000 && straight > 100);
}

static void test_far_from_the_anchor_too(void **state) {
    (void)state;
    const double anchor[2] = {-1e12 + 5, 1e9}, first[2] = {4e12 + 1, -3e12};
    const uint32_t size[2] = {MOST_PX - 2, 17};
    struct gn_shadow_drawn layout =
        lay(anchor[0], anchor[1], first[0], first[1], size[0], size[1], MOST_PX);
    expect_whole(&layout, anchor, first, size, MOST_PX);
}

static void test_a_window_within_a_page_is_drawn_as_it_is_read(void **state) {
    (void)state;
    struct gn_shadow_drawn layout = lay(-100, 10, -99, 11, 30, 30, 32); /* as wide as can be */
    assert_true(!layout.paged && layout.page_count == 1);
    assert_true(layout.corner_texels[0] == -100 && layout.corner_texels[1] == 10);
    assert_true(layout.px[0] == 1 && layout.pages[0].to_px[1] == 1);
    layout = lay(-100, 10, -100, 11, 30, 30, 32); /* on the page's edge, which must stay clear */
    assert_true(layout.paged && layout.page_count == 1);
    layout = lay(-100, 10, -98, 11, 30, 30, 32);
    assert_true(layout.paged && layout.page_count == 1);
    layout = lay(-100, 10, -97, 11, 30, 30, 32);
    assert_true(layout.paged && layout.page_count == 2);
    layout = lay(-100, 10, -97, 9, 30, 30, 32);
    assert_true(layout.paged && layout.page_count == 4);
    layout = lay(-100, 10, -100 + 32 + 4, 10 - 64 + 3, 20, 20, 32); /* another page */
    assert_true(!layout.paged && layout.corner_texels[0] == -68 && layout.corner_texels[1] == -54);
}

static void test_what_is_too_wide_is_cut(void **state) {
    (void)state;
    struct gn_shadow_drawn layout = lay(0, 0, 1, 1, 1000, 3, 16);
    assert_int_equal(layout.size_px[0], 14);
    assert_false(layout.paged);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pages_hold_all_of_a_window_once),
        cmocka_unit_test(test_far_from_the_anchor_too),
        cmocka_unit_test(test_a_window_within_a_page_is_drawn_as_it_is_read),
        cmocka_unit_test(test_what_is_too_wide_is_cut),
    };
    return RUN(tests);
}
