#include "cli/doctor_report.h"

#include <jansson.h>

#include "cli/doctor_input.h"
#include "core/json.h"
#include "scene/scene.h"
#include <config.h> /* made by the build */

/* What is used without a capability. */
static const char *const instead[GN_CAP_COUNT] = {
    [GN_CAP_DEPTH_COMPARE] = "shaders compare, on r32ui or r16f maps: slower; pcss for cone",
    [GN_CAP_R32UI] = "r16f or depth maps",
    [GN_CAP_R16F] = "r32ui maps, then depth, then rgba8",
    [GN_CAP_RGBA16F] = "8 bits a channel, ending at 1, in .pfm files of colour",
    [GN_CAP_SRGB] = "shaders encode sRGB: slower",
    [GN_CAP_MSAA4] = "no antialiasing",
    [GN_CAP_RGBA16UI] = "rgba32f-bits or rgba16f for msm",
    [GN_CAP_RG32UI] = "rgba16ui or rgba16f for vsm",
    [GN_CAP_RGBA32UI] = "pcf for evsm, vssm and smsm",
    [GN_CAP_RG16F] = "rg16f-bits or rg16f-bytes for cone",
    [GN_CAP_TIMER] = "bench times passes by the clock of the CPU",
    [GN_CAP_DEBUG] = "GL errors come without the driver's text",
};

/* ---- for people ---------------------------------------------------------------------------- */

/* The default format of a technique's maps. */
static const char *chosen_name(const struct gn_caps *caps, enum gn_technique technique) {
    bool fell_back;
    if (gn_technique_filters_map(technique))
        return gn_moments[gn_moments_choose(gn_techniques[technique].stores, GN_MOMENTS_NONE,
                                            gn_caps_moments(caps), &fell_back)]
            .name;
    return gn_encodings[gn_encoding_choose(technique, GN_ENCODING_AUTO, gn_caps_encodings(caps),
                                           &fell_back)]
        .name;
}

static void print_gpu(const struct gn_doctor_backend *b, FILE *to) {
    const struct gn_caps *caps = &b->caps;
    fprintf(to, "\nGPU (%s)\n", b->name);
    fprintf(to, "  %-11s %s%s\n", "renderer", caps->renderer, caps->software ? " - the CPU" : "");
    fprintf(to, "  %-11s %s\n  %-11s %s\n", "vendor", caps->vendor, "version", caps->version);
    fprintf(to, "  %-11s %d px, %d at once\n", "textures", caps->max_texture_px,
            caps->max_texture_units);
    fprintf(to, "  %-11s", "proved");
    for (int i = 0; i < GN_CAP_COUNT; i++)
        if (caps->has & 1u << i) fprintf(to, " %s", gn_cap_names[i]);
    fprintf(to, "\n");
    for (int i = 0; i < GN_CAP_COUNT; i++)
        if (!(caps->has & 1u << i))
            fprintf(to, "  %-11s %s; instead: %s\n", "not proved", gn_cap_names[i], instead[i]);
    fprintf(to, "  %-11s", "map formats");
    for (int i = 0; i < GN_ENCODING_COUNT; i++)
        if (gn_caps_encodings(caps) & 1u << i) fprintf(to, " %s", gn_encodings[i].name);
    for (int i = GN_MOMENTS_NONE + 1; i < GN_MOMENTS_COUNT; i++)
        if (gn_caps_moments(caps) & 1u << i) fprintf(to, " %s", gn_moments[i].name);
    fprintf(to, "\n  %-11s", "chosen");
    for (int i = 0; i < GN_TECHNIQUE_COUNT; i++)
        if (gn_techniques[i].file)
            fprintf(to, " %s:%s", gn_techniques[i].name, chosen_name(caps, (enum gn_technique)i));
    fprintf(to, "\n");
}

static void print_devices(const struct gn_machine *m, bool gpio, FILE *to) {
    static const char *const may[] = {"no access", "read only", "write only", "read and write"};
    bool any = false;
    fprintf(to, "\n%s\n", gpio ? "GPIO" : "Cards");
    for (int i = 0; i < m->device_count; i++) {
        const struct gn_device *device = &m->devices[i];
        if ((device->kind == GN_DEVICE_GPIO) != gpio) continue;
        fprintf(to, "  %-20s %-16s %s (group %s)%s%s\n", device->path,
                device->driver[0] ? device->driver : "unknown driver",
                may[device->readable + 2 * device->writable], device->group,
                device->holder[0] ? "; in use by " : "", device->holder);
        any = true;
    }
    if (!any) fprintf(to, "  none\n");
    for (int i = 0; i < m->connector_count && !gpio; i++)
        fprintf(to, "  %-20s %s%s%s\n", m->connectors[i].name, m->connectors[i].status,
                m->connectors[i].modes[0] ? ", " : "", m->connectors[i].modes);
}

/* What the kernel reports about it, which may be nothing. */
static void print_health(const struct gn_health *h, FILE *to) {
    char text[200];
    const bool tells_voltage = h->undervoltage >= 0 || h->firmware >= 0;
    const bool tells_clock = h->cooled >= 0 || h->firmware >= 0;
    if (!tells_voltage && !tells_clock && h->hottest_mc <= 0) return;
    const bool is_low = gn_health_explain(h, GN_HEALTH_VOLTAGE, -1, text, sizeof text);
    const bool is_slow = gn_health_explain(h, GN_HEALTH_THROTTLED, -1, text, sizeof text);
    fprintf(to, "\n  %-11s supply %s; clock %s", "health",
            !tells_voltage ? "unknown"
            : is_low       ? "too weak"
                           : "sufficient",
            !tells_clock ? "unknown"
            : is_slow    ? "lowered"
                         : "not lowered");
    if (h->hottest_mc > 0) fprintf(to, "; %.0f C", (double)h->hottest_mc * 1e-3);
}

void gn_doctor_print(const struct gn_doctor_report *report, FILE *to) {
    const struct gn_machine *m = &report->machine;
    fprintf(to, "gnomon %s\n\nMachine\n", GN_VERSION);
    if (m->model[0]) fprintf(to, "  %-11s %s\n", "board", m->model);
    fprintf(to, "  %-11s %s; %s; %s; %d CPU%s\n", "system", m->system[0] ? m->system : "unknown",
            m->kernel, m->arch, m->cpus, m->cpus == 1 ? "" : "s");
    fprintf(to, "  %-11s %llu MB, %llu MB free", "memory", (unsigned long long)m->memory_mb,
            (unsigned long long)m->free_mb);
    if (m->cma_mb) fprintf(to, ", %llu MB contiguous (CMA)", (unsigned long long)m->cma_mb);
    print_health(&report->health, to);
    char limits[400];
    gn_scene_limits_print(NULL, limits, sizeof limits);
    fprintf(to, "\n  %-11s %s", "limits", limits);
    fprintf(to, "\n  %-11s %s; groups", "user", m->user);
    for (int i = 0; i < m->group_count; i++) fprintf(to, " %s", m->groups[i]);

    fprintf(to, "\n  %-11s %s%s", "texts",
            report->texts[0] ? "missing: " : "in all scripts that gnomon knows", report->texts);

    fprintf(to, "\n\nBackends\n");
    for (int i = 0; i < report->backend_count; i++) {
        const struct gn_doctor_backend *b = &report->backends[i];
        fprintf(to, "  %-11s ", b->name);
        if (!b->built)
            fprintf(to, "not in this build\n");
        else if (b->opens)
            fprintf(to, "opens: %s\n", b->what);
        else
            fprintf(to, "does not open: %s\n", b->why);
    }

    if (report->chosen >= 0) print_gpu(&report->backends[report->chosen], to);
    print_devices(m, false, to);
    print_devices(m, true, to);
    gn_doctor_print_input(report, to);

    fprintf(to, "\nProblems\n");
    if (!report->problems.count) fprintf(to, "  none\n");
    for (uint32_t i = 0; i < report->problems.count; i++)
        fprintf(to, "  %u. %s\n     cure: %s\n", i + 1, report->problems.items[i].what,
                report->problems.items[i].cure);
    if (report->self_test) gn_selftest_print(report->self_test, to);
}

/* ---- for programs -------------------------------------------------------------------------- */

/* An empty text is unknown: null. */
static json_t *text_json(const char *value) {
    return gn_json_make_text(value && value[0] ? value : NULL);
}

static json_t *gpu_json(const struct gn_doctor_backend *b) {
    const struct gn_caps *caps = &b->caps;
    json_t *proved = json_array(), *not_proved = json_array();
    for (int i = 0; i < GN_CAP_COUNT; i++)
        if (caps->has & 1u << i)
            json_array_append_new(proved, json_string(gn_cap_names[i]));
        else
            json_array_append_new(
                not_proved, json_pack("{ss ss}", "name", gn_cap_names[i], "instead", instead[i]));
    json_t *formats = json_array(), *chosen = json_object();
    for (int i = 0; i < GN_ENCODING_COUNT; i++)
        if (gn_caps_encodings(caps) & 1u << i)
            json_array_append_new(formats, json_string(gn_encodings[i].name));
    for (int i = GN_MOMENTS_NONE + 1; i < GN_MOMENTS_COUNT; i++)
        if (gn_caps_moments(caps) & 1u << i)
            json_array_append_new(formats, json_string(gn_moments[i].name));
    for (int i = 0; i < GN_TECHNIQUE_COUNT; i++)
        if (gn_techniques[i].file)
            json_object_set_new(chosen, gn_techniques[i].name,
                                json_string(chosen_name(caps, (enum gn_technique)i)));
    return json_pack("{ss so so so so sb si si so so so so}", "backend", b->name, "vendor",
                     text_json(caps->vendor), "renderer", text_json(caps->renderer), "gles",
                     text_json(caps->version), "egl", text_json(b->egl), "software", caps->software,
                     "max_texture_px", caps->max_texture_px, "texture_units",
                     caps->max_texture_units, "proved", proved, "not_proved", not_proved,
                     "map_formats", formats, "auto", chosen);
}

static json_t *devices_json(const struct gn_doctor_report *report, bool gpio) {
    const struct gn_machine *m = &report->machine;
    json_t *all = json_array();
    for (int i = 0; i < m->device_count; i++) {
        const struct gn_device *d = &m->devices[i];
        if ((d->kind == GN_DEVICE_GPIO) != gpio) continue;
        json_t *device =
            json_pack("{so so so sb sb}", "path", text_json(d->path), gpio ? "device" : "driver",
                      text_json(d->driver), "group", text_json(d->group), "readable", d->readable,
                      "writable", d->writable);
        if (gpio) {
            gn_doctor_describe_chip(report, d->path, device);
        } else {
            json_object_set_new(device, "kind",
                                json_string(d->kind == GN_DEVICE_CARD ? "card" : "render"));
            json_object_set_new(device, "holder", text_json(d->holder));
        }
        json_array_append_new(all, device);
    }
    return all;
}

static json_t *health_json(const struct gn_health *h) {
    char text[200];
    json_t *all = json_array();
    for (int i = 0; i < GN_HEALTH_COUNT; i++)
        if (gn_health_explain(h, (enum gn_health_kind)i, -1, text, sizeof text))
            json_array_append_new(all, json_string(gn_health_names[i]));
    return all;
}

json_t *gn_doctor_json(const struct gn_doctor_report *report) {
    const struct gn_machine *m = &report->machine;
    const bool draws = report->chosen >= 0;
    json_t *groups = json_array(), *backends = json_array(), *connectors = json_array();
    char limits[400];
    gn_scene_limits_print(NULL, limits, sizeof limits);
    for (int i = 0; i < m->group_count; i++) json_array_append_new(groups, text_json(m->groups[i]));
    json_t *machine =
        json_pack("{so so so so so si sI sI sI so ss so so}", "model", text_json(m->model), "cpu",
                  text_json(m->cpu), "system", text_json(m->system), "kernel", text_json(m->kernel),
                  "arch", text_json(m->arch), "cpus", m->cpus, "memory_mb",
                  (json_int_t)m->memory_mb, "memory_free_mb", (json_int_t)m->free_mb, "cma_mb",
                  (json_int_t)m->cma_mb, "health", health_json(&report->health), "limits", limits,
                  "user", text_json(m->user), "groups", groups);
    for (int i = 0; i < report->backend_count; i++) {
        const struct gn_doctor_backend *b = &report->backends[i];
        json_array_append_new(
            backends, json_pack("{ss so sb sb so so so so so so}", "name", b->name, "what",
                                text_json(b->what), "built", b->built, "opens", b->opens, "why",
                                text_json(b->why), "vendor", text_json(b->caps.vendor), "renderer",
                                text_json(b->caps.renderer), "gles", text_json(b->caps.version),
                                "egl", text_json(b->egl), "software",
                                b->opens ? json_boolean(b->caps.software) : json_null()));
    }
    for (int i = 0; i < m->connector_count; i++) {
        const struct gn_connector *c = &m->connectors[i];
        json_array_append_new(connectors,
                              json_pack("{so so so so so}", "name", text_json(c->name), "status",
                                        text_json(c->status), "mode", text_json(c->mode), "modes",
                                        text_json(c->modes), "monitor", text_json(c->monitor)));
    }
    json_t *all =
        json_pack("{ss sb so so so so so so so so so}", "version", GN_VERSION, "can_draw", draws,
                  "machine", machine, "backends", backends, "gpu",
                  draws ? gpu_json(&report->backends[report->chosen]) : json_null(), "cards",
                  devices_json(report, false), "connectors", connectors, "gpio",
                  devices_json(report, true), "texts_missing", text_json(report->texts), "input",
                  gn_doctor_input_json(report), "problems", gn_problem_json(&report->problems));
    if (all && report->self_test)
        json_object_set_new(all, "self_test", gn_selftest_json(report->self_test));
    return all;
}

bool gn_doctor_print_json(const struct gn_doctor_report *report, FILE *to, struct gn_err *err) {
    return gn_json_print(gn_doctor_json(report), 7, to, err);
}
