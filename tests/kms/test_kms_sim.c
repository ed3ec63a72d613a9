/* Tests of the simulator: it implements the kernel's rules and detects violations. */
#include <drm_fourcc.h>
#include <errno.h>

#include "scenes.h"
#include "unit/check.h"

static struct {
    int fd;
    uint32_t connector, crtc, handle, fb;
    drmModeModeInfo mode;
} k;

static uint32_t add_fb(uint32_t handle) {
    uint32_t fb = 0;
    const uint32_t handles[4] = {handle}, strides[4] = {4 * 96}, offsets[4] = {0};
    assert_int_equal(
        sim_drm.ModeAddFB2(k.fd, 96, 54, DRM_FORMAT_XRGB8888, handles, strides, offsets, &fb, 0),
        0);
    return fb;
}

static uint32_t create_dumb(void) {
    struct drm_mode_create_dumb made = {.width = 96, .height = 54, .bpp = 32};
    assert_int_equal(sim_drm.Ioctl(k.fd, DRM_IOCTL_MODE_CREATE_DUMB, &made), 0);
    return made.handle;
}

static void destroy_dumb(uint32_t handle) {
    struct drm_mode_destroy_dumb which = {.handle = handle};
    assert_int_equal(sim_drm.Ioctl(k.fd, DRM_IOCTL_MODE_DESTROY_DUMB, &which), 0);
}

static int set_up(void **state) {
    (void)state;
    sim_begin();
    sim_add_card(0, "/dev/dri/card0", &(struct sim_traits){0});
    sim_plug(0, 0, SIM_FULL_HD);
    k.fd = sim_drm.open("/dev/dri/card0");
    drmModeRes *res = sim_drm.ModeGetResources(k.fd);
    k.connector = res->connectors[0];
    k.crtc = res->crtcs[0];
    sim_drm.ModeFreeResources(res);
    drmModeConnector *c = sim_drm.ModeGetConnector(k.fd, k.connector);
    k.mode = c->modes[0];
    sim_drm.ModeFreeConnector(c);
    k.handle = create_dumb();
    k.fb = add_fb(k.handle);
    return 0;
}

static int set_crtc(void) {
    return sim_drm.ModeSetCrtc(k.fd, k.crtc, k.fb, 0, 0, &k.connector, 1, &k.mode);
}

static int page_flip(void) {
    return sim_drm.ModePageFlip(k.fd, k.crtc, k.fb, DRM_MODE_PAGE_FLIP_EVENT, &k);
}

static void clean_up(void) {
    sim_drm.ModeRmFB(k.fd, k.fb);
    destroy_dumb(k.handle);
    sim_drm.close(k.fd);
    assert_int_equal(sim_end(), 0);
}

static void test_valid_use(void **state) {
    (void)state;
    assert_int_equal(set_crtc(), 0);
    assert_true(sim_shows(0));
    assert_int_equal(page_flip(), 0);
    assert_false(sim_readable(k.fd));
    sim_run_to(sim_now() + 40 * SIM_MS);
    assert_true(sim_readable(k.fd));
    clean_up();
}

static void test_flip_while_pending(void **state) {
    (void)state;
    set_crtc();
    assert_int_equal(page_flip(), 0);
    assert_int_equal(page_flip(), -EBUSY);
    assert_string_equal(sim_complaint(), "page flip while a flip is pending");
}

static void test_flip_on_inactive_crtc(void **state) {
    (void)state;
    assert_int_equal(page_flip(), -EBUSY);
    clean_up();
}

static void test_single_master(void **state) {
    (void)state;
    const int second = sim_drm.open("/dev/dri/card0");
    assert_false(sim_drm.IsMaster(second));
    assert_int_equal(sim_drm.SetMaster(second), -1);
    assert_int_equal(errno, EACCES);
    assert_int_equal(sim_drm.DropMaster(k.fd), 0);
    assert_int_equal(set_crtc(), -EACCES);
    assert_int_equal(sim_drm.SetMaster(second), 0);
    assert_int_equal(sim_drm.SetMaster(k.fd), -1);
    sim_drm.close(second);
    assert_int_equal(sim_drm.SetMaster(k.fd), 0);
    assert_int_equal(set_crtc(), 0);
    clean_up();
}

static void test_removal_disables_crtc(void **state) {
    (void)state;
    set_crtc();
    assert_int_equal(sim_drm.ModeRmFB(k.fd, k.fb), 0);
    assert_false(sim_shows(0));
    k.fb = add_fb(k.handle);
    clean_up();
}

static void test_lost_card(void **state) {
    (void)state;
    set_crtc();
    sim_lose_card(0);
    assert_int_equal(page_flip(), -ENODEV);
    sim_return_card(0, "/dev/dri/card5");
    assert_int_equal(page_flip(), -ENODEV);
    sim_drm.ModeRmFB(k.fd, k.fb);
    struct drm_mode_destroy_dumb which = {.handle = k.handle};
    sim_drm.Ioctl(k.fd, DRM_IOCTL_MODE_DESTROY_DUMB, &which);
    sim_drm.close(k.fd);
    assert_int_equal(sim_end(), 0);
}

static void test_leak_is_reported(void **state) {
    (void)state;
    add_fb(k.handle);
    sim_drm.ModeRmFB(k.fd, k.fb);
    destroy_dumb(k.handle);
    sim_drm.close(k.fd);
    assert_true(sim_end() > 0);
    assert_string_equal(sim_complaint(), "framebuffer leaked at close");
}

static void test_double_free_is_reported(void **state) {
    (void)state;
    sim_drm.ModeRmFB(k.fd, k.fb);
    assert_int_equal(sim_drm.ModeRmFB(k.fd, k.fb), -ENOENT);
    assert_true(sim_counts.complaints == 1);
    sim_drm.close(k.fd);
    sim_drm.close(k.fd);
    assert_true(sim_counts.complaints >= 3); /* the dumb buffer is reported, too */
}

static void test_test_only_changes_nothing(void **state) {
    (void)state;
    assert_int_equal(set_crtc(), 0);
    assert_int_equal(sim_drm.SetClientCap(k.fd, DRM_CLIENT_CAP_ATOMIC, 1), 0);
    drmModeAtomicReq *r = sim_drm.ModeAtomicAlloc();
    drmModeObjectProperties *all =
        sim_drm.ModeObjectGetProperties(k.fd, k.crtc, DRM_MODE_OBJECT_CRTC);
    assert_int_equal(all->count_props, 2);
    sim_drm.ModeAtomicAddProperty(r, k.crtc, all->props[0], 0); /* ACTIVE */
    sim_drm.ModeFreeObjectProperties(all);
    assert_int_equal(sim_drm.ModeAtomicCommit(k.fd, r, DRM_MODE_ATOMIC_TEST_ONLY, NULL), -EINVAL);
    const uint32_t modeset = DRM_MODE_ATOMIC_ALLOW_MODESET;
    assert_int_equal(sim_drm.ModeAtomicCommit(k.fd, r, modeset | DRM_MODE_ATOMIC_TEST_ONLY, NULL),
                     0);
    assert_true(sim_shows(0));
    assert_int_equal(sim_drm.ModeAtomicCommit(k.fd, r, modeset, NULL), 0);
    assert_false(sim_shows(0));
    sim_drm.ModeAtomicFree(r);
    clean_up();
}

static void test_stall_times_out(void **state) {
    (void)state;
    set_crtc();
    sim_stall(0, SIM_STALLS);
    const int64_t from_ns = sim_now();
    page_flip();
    set_crtc(); /* blocks */
    assert_in_range(sim_now() - from_ns, 10 * SIM_S, 10 * SIM_S + 100 * SIM_MS);
    assert_false(sim_readable(k.fd));
    clean_up();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_valid_use, set_up),
        cmocka_unit_test_setup(test_flip_while_pending, set_up),
        cmocka_unit_test_setup(test_flip_on_inactive_crtc, set_up),
        cmocka_unit_test_setup(test_single_master, set_up),
        cmocka_unit_test_setup(test_removal_disables_crtc, set_up),
        cmocka_unit_test_setup(test_lost_card, set_up),
        cmocka_unit_test_setup(test_leak_is_reported, set_up),
        cmocka_unit_test_setup(test_double_free_is_reported, set_up),
        cmocka_unit_test_setup(test_test_only_changes_nothing, set_up),
        cmocka_unit_test_setup(test_stall_times_out, set_up),
    };
    return RUN(tests);
}
