/* The table of options, one row each: GN_OPTION(fields of struct gn_option_row). Included once to
 * count the rows (table.h) and once to make them (table.c), hence without a guard. A row and its
 * field in settings.h make an option. FIELD, LIGHT, commands and lists of choices: table.c. */
/* clang-format off */

/* the scene, and how it stands */
GN_OPTION(.name = "scene", .key = "file", .section = "scene", .kind = GN_KIND_SCENES, .value = "FILE",
          .help = "scene file (.glb, .gltf, .obj, .fbx, .stl, .ply, .dae); may be repeated: next-scene goes through the list; on the command line it needs no flag", .change = GN_CHANGE_RELOAD, .offset = FIELD(scene.path))
GN_OPTION(.name = "camera", .section = "scene", .kind = GN_KIND_TEXT, .value = "NAME|N|light:NAME|auto",
          .help = "camera of the scene, or the view of a spot or directional light; auto: the first camera, but if it sees less than a third of the model one that shows all of it", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .offset = FIELD(scene.camera))
GN_OPTION(.name = "animation", .section = "scene", .kind = GN_KIND_TEXT, .value = "NAME|N|none",
          .help = "play only this clip (default: all that do not collide)", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .offset = FIELD(scene.animation))
GN_OPTION(.name = "no-animation", .section = "scene", .kind = GN_KIND_FLAG,
          .help = "do not animate", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .offset = FIELD(scene.no_animation))
GN_OPTION(.name = "animation-loop", .section = "scene", .kind = GN_KIND_CHOICE, .choices = clip_turns, .value = "HOW", .fallback = "loop",
          .help = "what clips do at their end: begin again, stay there, or go back", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(scene.animation_turns))
GN_OPTION(.name = "animation-speed", .section = "scene", .kind = GN_KIND_NUMBER, .min = 0, .max = 100, .value = "F", .fallback = "1",
          .help = "factor on the speed of clips", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(scene.animation_speed))
GN_OPTION(.name = "animation-start", .section = "scene", .kind = GN_KIND_SECONDS, .max = 1e9, .value = "S", .unit = "seconds", .fallback = "0",
          .help = "time within each clip at which it begins, whatever its speed", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(scene.animation_start_ns))
GN_OPTION(.name = "animation-restart", .section = "scene", .kind = GN_KIND_FLAG,
          .help = "clips start again when the mode is entered, when a scene is entered in it, and when a button or gnomon ctl names the mode that is already shown", .commands = KIOSK, .change = GN_CHANGE_LIVE, .offset = FIELD(scene.animation_restart))
GN_OPTION(.name = "variant", .section = "scene", .kind = GN_KIND_TEXT, .value = "NAME|N|auto",
          .help = "variant of the scene's materials (KHR_materials_variants); auto: the file's default materials", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(scene.variant))
GN_OPTION(.name = "time", .section = "scene", .kind = GN_KIND_SECONDS, .max = 1e9, .value = "S", .unit = "seconds", .fallback = "0",
          .help = "start at this time of the animation", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(scene.time_ns))
GN_OPTION(.name = "floor", .section = "scene", .kind = GN_KIND_LEVEL, .min = -1e6, .max = 1e6, .value = "auto|none|HEIGHT", .unit = "metres", .fallback = "auto",
          .help = "an unseen floor that catches the shadows: under a model that stands on nothing (auto), or at a height", .commands = DRAW | MODEL, .change = GN_CHANGE_RELOAD, .offset = FIELD(scene.floor_m))
GN_OPTION(.name = "texture-limit", .section = "scene", .kind = GN_KIND_LEVEL, .min = 16, .max = 16384, .value = "auto|none|PX", .unit = "pixels", .fallback = "auto",
          .help = "halve textures that are wider or higher than this when a scene is loaded, until they fit; auto: 2048 for bake, else the largest size that the GPU supports", .commands = DRAW | MODEL | BIT(BAKE), .change = GN_CHANGE_RELOAD, .offset = FIELD(scene.texture_limit_px))
GN_OPTION(.name = "turntable", .section = "scene", .kind = GN_KIND_NUMBER, .min = -3600, .max = 3600, .value = "DEG",
          .unit = "degrees per second", .fallback = "0",
          .help = "turn the camera around the scene", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .offset = FIELD(scene.turntable_deg_s))
GN_OPTION(.name = "turntable-rest", .section = "scene", .kind = GN_KIND_SECONDS, .max = 86400, .value = "S", .unit = "seconds", .fallback = "5",
          .help = "how long the turntable rests after the view was turned by hand; then it goes on from there. 0: it never rests", .commands = KIOSK, .change = GN_CHANGE_LIVE, .offset = FIELD(scene.turntable_rest_ns))
GN_OPTION(.name = "detail", .section = "render", .kind = GN_KIND_SHARE, .min = 0, .max = 16, .value = "auto|full|PX", .unit = "pixels", .fallback = "full",
          .help = "draw meshes of 2,000 triangles or more with fewer of them, so much off at most, chosen by distance; auto: one pixel at its nearest part, where fine bumps may lose some of their shading; full: never", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .offset = FIELD(render.detail_px))
/* the picture */
GN_OPTION(.name = "size", .section = "render", .kind = GN_KIND_SIZE, .min = 1, .max = 16384, .value = "WxH", .unit = "pixels",
          .fallback = "1280x720", .help = "size of the picture", .commands = DRAW | MODEL | BIT(LESSON), .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(render.size))
GN_OPTION(.name = "shadow", .section = "render", .kind = GN_KIND_TECHNIQUES, .value = "TECHNIQUE", .fallback = "pcf",
          .help = "shadow technique, cone for the key light of a scene without lights; for bench a comma-separated list", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(technique), .offset = FIELD(render.shadow))
GN_OPTION(.name = "map", .section = "render", .kind = GN_KIND_INT, .min = 16, .max = 16384, .value = "PX", .unit = "pixels",
          .fallback = "1024", .help = "shadow map resolution in texels (512 for vssm and smsm); not given, up to 2048 where a map then stays as it is while the camera moves", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(map_px), .offset = FIELD(render.map_px))
GN_OPTION(.name = "map-format", .section = "render", .kind = GN_KIND_CHOICE, .choices = map_formats, .value = "FORMAT", .fallback = "auto",
          .help = "texture format of shadow maps; rg32ui and those after it: for filtered techniques", .commands = DRAW, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(map_format), .offset = FIELD(render.map_format))
GN_OPTION(.name = "map-clear", .section = "render", .kind = GN_KIND_CHOICE, .choices = map_ends, .value = "END", .fallback = "far",
          .help = "end of the light's distances to which maps other than depth textures are cleared; near is wrong, for gnomon lesson clear", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(render.map_clears_near))
GN_OPTION(.name = "cascades", .section = "render", .kind = GN_KIND_CHOICE, .choices = cascade_counts, .value = "N", .fallback = "auto",
          .help = "number of maps that share the view of a directional light", .commands = DRAW, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(cascades), .offset = FIELD(render.cascades))
GN_OPTION(.name = "cast-faces", .section = "render", .kind = GN_KIND_CHOICE, .choices = cast_faces, .value = "FACES", .fallback = "auto",
          .help = "faces that cast into shadow maps: auto: as the scene sets it for each object; for all objects those that face the light (front), face away from it (back), both, or the middle between the two", .commands = DRAW, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(faces), .offset = FIELD(render.cast_faces))
GN_OPTION(.name = "planar", .section = "render", .kind = GN_KIND_CHOICE, .choices = planar_ways, .value = "WAY", .fallback = "mask",
          .help = "draw planar shadows with a mask texture (edges one texel soft), the stencil buffer (sharp edges) or the mean of masks over the lamp (exact penumbrae)", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .offset = FIELD(render.planar))
GN_OPTION(.name = "planar-points", .section = "render", .kind = GN_KIND_CHOICE, .choices = lamp_points, .value = "N", .fallback = "64",
          .help = "number of points of the lamp with planar soft; where frames follow each other, 16 more with each frame in which nothing moves", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(render.planar_points))
GN_OPTION(.name = "taps", .section = "render", .kind = GN_KIND_CHOICE, .choices = tap_counts, .value = "N", .fallback = "auto",
          .help = "number of samples of disk, poisson, white, pcss (auto: 16) and cone (auto: 12; 8 to 16)", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(taps), .offset = FIELD(render.taps))
GN_OPTION(.name = "taps-fixed", .section = "render", .kind = GN_KIND_FLAG,
          .help = "do not rotate the sample pattern per pixel (banding instead of noise)", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(render.taps_fixed))
GN_OPTION(.name = "filter-budget", .section = "render", .kind = GN_KIND_NUMBER, .max = 10000, .value = "N", .unit = "million texels", .fallback = "4",
          .help = "limit on filtered maps updated in one frame when many lights move; 0: no limit", .commands = KIOSK, .change = GN_CHANGE_LIVE, .offset = FIELD(render.filter_budget))
GN_OPTION(.name = "shadow-strength", .section = "render", .kind = GN_KIND_NUMBER, .max = 1, .value = "X", .fallback = "1",
          .help = "share of direct light that a shadow removes", .commands = DRAW, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(strength), .offset = FIELD(render.shadow_strength))
GN_OPTION(.name = "shadow-specular", .section = "render", .kind = GN_KIND_EV, .max = 1, .value = "auto|X", .fallback = "auto",
          .help = "share of highlights that stays in shadow; auto: as the scene sets it, else as of the rest", .commands = DRAW, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(specular), .offset = FIELD(render.shadow_specular))
GN_OPTION(.name = "bias", .section = "render", .kind = GN_KIND_EV, .max = 100, .value = "auto|TEXELS", .unit = "texels", .fallback = "auto",
          .help = "bias of shadow maps: 0 shows acne, large ones detach shadows from what casts them", .commands = DRAW, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(bias_texels), .offset = FIELD(render.bias_texels))
GN_OPTION(.name = "filter-radius", .section = "render", .kind = GN_KIND_EV, .min = 1, .max = 32, .value = "auto|TEXELS", .unit = "texels", .fallback = "auto",
          .help = "radius of the filter of disk, poisson and white (3 by itself), of pcf (1.5; at most 2) and of the blur of vsm, evsm and msm (1.5 to 4.5, by the light's size)", .commands = DRAW, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(filter_radius_px), .offset = FIELD(render.filter_radius_px))
GN_OPTION(.name = "slide-aspect", .section = "render", .kind = GN_KIND_CHOICE, .choices = slide_aspects, .value = "SHAPE", .fallback = "square",
          .help = "shape of a slide whose size the scene does not give; it fills the cone of its spot", .commands = DRAW, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(slide_as_picture), .offset = FIELD(render.slide_as_picture))
GN_OPTION(.name = "slide-far", .section = "render", .kind = GN_KIND_EV, .max = 1e6, .value = "auto|M", .unit = "metres", .fallback = "auto",
          .help = "depth in the light's cone at which the picture of a slide ends; auto: as the scene sets it; 0: nowhere", .commands = DRAW, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(slide_far_m), .offset = FIELD(render.slide_far_m))
GN_OPTION(.name = "environment", .section = "render", .kind = GN_KIND_PATH, .choices = environments, .value = "auto|studio|none|FILE.hdr", .fallback = "auto",
          .help = "light from all directions: the studio inside the program, a Radiance picture, or none; by itself studio for a scene without lights of its own, and in others only as reflections of metal", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .offset = FIELD(render.environment))
GN_OPTION(.name = "environment-turn", .section = "render", .kind = GN_KIND_NUMBER, .min = -360, .max = 360, .value = "DEG", .unit = "degrees", .fallback = "0",
          .help = "turn the environment about the vertical axis, counter-clockwise seen from above", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(render.environment_turn_deg))
GN_OPTION(.name = "environment-strength", .section = "render", .kind = GN_KIND_NUMBER, .max = 1000, .value = "X", .fallback = "1",
          .help = "factor on the environment's light", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(render.environment_strength))
GN_OPTION(.name = "environment-show", .section = "render", .kind = GN_KIND_CHOICE, .choices = environment_shows, .value = "no|yes|blur", .fallback = "no",
          .help = "draw the environment as the background, unless that is transparent", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(render.environment_show))
GN_OPTION(.name = "occlusion", .section = "render", .kind = GN_KIND_CHOICE, .choices = occlusions, .value = "auto|none", .fallback = "auto",
          .help = "ambient occlusion: less light from all directions where the model itself blocks it; auto: where an environment lights the model, on all of it that stays where it is over the clips that play, unless the shape is too fine for its 32,768 cubes", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .offset = FIELD(render.occlusion))
GN_OPTION(.name = "gather", .section = "render", .kind = GN_KIND_CHOICE, .choices = gathers, .value = "auto|none|always", .fallback = "auto",
          .help = "soft shadows of a scene that stands still; auto: after a third of a second they converge to those from many points of each light, until something moves; always: in each .png of render, too, which then takes two to six times as long", .commands = KIOSK | BIT(RENDER), .change = GN_CHANGE_LIVE, .offset = FIELD(render.gather))
GN_OPTION(.name = "show-lights", .section = "render", .kind = GN_KIND_FLAG,
          .help = "draw a gizmo at each light", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(render.show_lights))
GN_OPTION(.name = "show-maps", .section = "render", .kind = GN_KIND_FLAG,
          .help = "show the lights' shadow maps along the lower edge of the picture", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(render.show_maps))
GN_OPTION(.name = "light", .section = "render", .kind = GN_KIND_INT, .max = 65535, .value = "N", .fallback = "0",
          .help = "number of the light for --aov visibility and map", .commands = BIT(RENDER), .offset = FIELD(render.light))
GN_OPTION(.name = "aov", .section = "render", .kind = GN_KIND_CHOICE, .choices = aovs, .value = "WHAT", .fallback = "color",
          .help = "output variable to draw; sun-hours: for how many hours of --date, a day, or between --from and --to, each surface sees the sun of --sun: false colours with a scale in .png, hours in .pfm", .commands = BIT(RENDER), .offset = FIELD(render.aov))
GN_OPTION(.name = "output", .section = "render", .kind = GN_KIND_CHOICE, .choices = outputs, .value = "SPACE", .fallback = "srgb",
          .help = "encoding of colour; linear is for measurement", .commands = BIT(RENDER) | BIT(BENCH), .offset = FIELD(render.output))
GN_OPTION(.name = "exposure", .section = "render", .kind = GN_KIND_EV, .min = -24, .max = 24, .value = "auto|EV", .unit = "stops",
          .fallback = "auto", .help = "exposure; at 0 radiance 1 is white", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(render.exposure_ev))
GN_OPTION(.name = "tone", .section = "render", .kind = GN_KIND_CHOICE, .choices = tones, .value = "OPERATOR", .fallback = "auto",
          .help = "tone mapping; auto: neutral for a scene without lights of its own, else none; never with --output linear, .pfm or --aov", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .offset = FIELD(render.tone))
GN_OPTION(.name = "background", .section = "render", .kind = GN_KIND_COLOR, .choices = backgrounds, .value = "COLOUR", .fallback = "auto",
          .help = "what is behind the scene: a colour #rrggbb; auto: gnomon_background, else a grey in the light of the studio where that lights the scene, else sky; sky: the mean of gnomon_sky and gnomon_ground; transparent: .png files get straight alpha, screens black", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(render.background))
GN_OPTION(.name = "msaa", .section = "render", .kind = GN_KIND_CHOICE, .choices = samples, .value = "N", .unit = "samples", .fallback = "auto",
          .help = "multisampling; auto: 4, if they take at most 256 MB; 0 on screens drawn by software, with --output linear, .pfm, --aov and --shadow truth", .commands = DRAW | MODEL, .change = GN_CHANGE_RELOAD, .offset = FIELD(render.msaa))
GN_OPTION(.name = "font", .section = "render", .kind = GN_KIND_PATH, .value = "FILE",
          .help = "font of captions (.ttf, .otf); without it DejaVu Sans or a similar one", .commands = KIOSK | BIT(RENDER), .change = GN_CHANGE_RELOAD, .offset = FIELD(render.font))
GN_OPTION(.name = "shaders", .section = "render", .kind = GN_KIND_PATH, .value = "DIR",
          .help = "read the shaders from this folder; show reads them again when they change", .commands = DRAW | BIT(DOCTOR) | BIT(LESSON), .change = GN_CHANGE_RELOAD, .offset = FIELD(render.shaders))
GN_OPTION(.name = "without", .section = "render", .kind = GN_KIND_CAPS, .value = "CAP,..",
          .help = "do not use these GPU capabilities, named as doctor prints them", .commands = DRAW | BIT(DOCTOR), .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(render.without))
GN_OPTION(.name = "limit", .section = "render", .kind = GN_KIND_LIMIT, .min = 1, .max = 1099511627776.0, .value = "NAME=VALUE",
          .help = "limit on the size of a scene, or on the processor time that loading one may take; may be repeated", .commands = DRAW | BIT(INSPECT) | BIT(BAKE), .change = GN_CHANGE_RELOAD, .offset = FIELD(render.limits))
/* the key light of a scene without lights; those of_light are of any other too */
GN_OPTION(.name = "light-azimuth", .key = "azimuth", .section = "light", .kind = GN_KIND_EV, .min = -360, .max = 360, .value = "auto|DEG", .unit = "degrees", .fallback = "auto",
          .help = "where the key light comes from: 0 from the front (+Z), 90 from +X, as the scene stands; with --light-follow camera 0 from the camera, 90 from its right", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(light.azimuth_deg))
GN_OPTION(.name = "light-elevation", .key = "elevation", .section = "light", .kind = GN_KIND_EV, .min = -90, .max = 90, .value = "auto|DEG", .unit = "degrees", .fallback = "auto",
          .help = "height of the key light over the horizon: 90 from straight above", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(light.elevation_deg))
GN_OPTION(.name = "light-follow", .key = "follow", .section = "light", .kind = GN_KIND_CHOICE, .choices = follows, .value = "WHAT", .fallback = "world",
          .help = "what the key light is fixed to: the scene, or the camera, so that it turns with the view, also by a turntable or the mouse", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(light.follows_camera))
GN_OPTION(.name = "light-color", .key = "color", .section = "light", .kind = GN_KIND_COLOR, .choices = light_colors, .value = "COLOUR", .fallback = "auto",
          .help = "colour of the key light, #rrggbb; its brightness does not count", .commands = DRAW, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(hue), .offset = FIELD(light.color))
GN_OPTION(.name = "light-lux", .key = "lux", .section = "light", .kind = GN_KIND_EV, .max = 1e6, .value = "auto|LUX", .unit = "lux", .fallback = "auto",
          .help = "illuminance by the key light; auto: that of its environment, 2.4 in the studio, or 2.8 without one. With --exposure 0 a white surface that faces 3.14 lux is white", .commands = DRAW, .change = GN_CHANGE_LIVE, .target = LIGHT(intensity), .offset = FIELD(light.lux))
GN_OPTION(.name = "light-radius", .key = "radius", .section = "light", .kind = GN_KIND_EV, .max = 1000, .value = "auto|R", .fallback = "auto",
          .help = "size of the key light, by which pcss, cone and other soft techniques draw penumbrae: tangent of its angular radius; of a light that is not directional: metres; auto: that of its environment, .24 in the studio, or .00465 without one", .commands = DRAW, .change = GN_CHANGE_LIVE, .of_light = true, .target = LIGHT(radius), .offset = FIELD(light.radius))
GN_OPTION(.name = "light-intensity", .key = "intensity", .kind = GN_KIND_EV, .max = 1e9, .value = "auto|X", .fallback = "auto",
          .help = "intensity in the unit of the light, as in the file and as inspect prints it: candela, of a directional one lux", .of_light = true, .target = LIGHT(intensity), .offset = FIELD(light.intensity))
GN_OPTION(.name = "light-on", .key = "on", .kind = GN_KIND_FLAG, .fallback = "yes",
          .help = "whether the light shines", .of_light = true, .target = LIGHT(on), .offset = FIELD(light.on))
/* the sun; north is -Z, or as gnomon_north has it */
GN_OPTION(.name = "sun", .kind = GN_KIND_PLACE, .min = -180, .max = 180, .value = "LAT,LON", .fallback = "auto",
          .help = "the sun as it stands at this place, in degrees north and east: a light of the scene gets its direction, size, colour and strength", .commands = DRAW | MODEL, .offset = FIELD(sun.place_deg))
GN_OPTION(.name = "sun-latitude", .key = "latitude", .section = "sun", .kind = GN_KIND_EV, .min = -90, .max = 90, .value = "auto|DEG", .unit = "degrees", .fallback = "auto",
          .help = "latitude of the place, north positive; the sundial of the default scene is made for 50", .change = GN_CHANGE_LIVE, .offset = FIELD(sun.latitude_deg))
GN_OPTION(.name = "sun-longitude", .key = "longitude", .section = "sun", .kind = GN_KIND_EV, .min = -180, .max = 180, .value = "auto|DEG", .unit = "degrees", .fallback = "auto",
          .help = "longitude of the place, east positive", .change = GN_CHANGE_LIVE, .offset = FIELD(sun.longitude_deg))
GN_OPTION(.name = "date", .section = "sun", .kind = GN_KIND_DATE, .value = "DATE", .fallback = "now",
          .help = "moment of the sun: now, or a date 2026-12-21 (its noon by the clock), or one with a time 2026-12-21T09:30 by the clock of time_zone, unless Z or +01:00 follows", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .offset = FIELD(sun.date))
GN_OPTION(.name = "from", .kind = GN_KIND_DATE, .value = "DATE",
          .help = "of --aov sun-hours, in place of a day: the first moment, as 2026-12-21T09:00", .commands = BIT(RENDER), .offset = FIELD(run.from))
GN_OPTION(.name = "to", .kind = GN_KIND_DATE, .value = "DATE",
          .help = "and the last one, at most a day later", .commands = BIT(RENDER), .offset = FIELD(run.to))
GN_OPTION(.name = "sun-time-zone", .key = "time_zone", .section = "sun", .kind = GN_KIND_TEXT, .value = "ZONE",
          .help = "time zone of date, as Europe/Berlin; without it the system's", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .offset = FIELD(sun.time_zone))
GN_OPTION(.name = "sun-speed", .key = "speed", .section = "sun", .kind = GN_KIND_NUMBER, .min = -1e6, .max = 1e6, .value = "F", .fallback = "1",
          .help = "how fast the sun goes on from date: 1 as the clock, 3600 an hour in a second, 0 not at all; also from frame to frame of render --frames", .commands = KIOSK | BIT(RENDER), .change = GN_CHANGE_LIVE, .offset = FIELD(sun.speed))
GN_OPTION(.name = "sun-azimuth", .key = "azimuth", .section = "sun", .kind = GN_KIND_EV, .min = -360, .max = 360, .value = "auto|DEG", .unit = "degrees", .fallback = "auto",
          .help = "where the sun stands, from north over east, in place of what place and date make; without a place auto is 180, south", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .offset = FIELD(sun.azimuth_deg))
GN_OPTION(.name = "sun-altitude", .key = "altitude", .section = "sun", .kind = GN_KIND_EV, .min = -90, .max = 90, .value = "auto|DEG", .unit = "degrees", .fallback = "auto",
          .help = "how high the sun stands over the horizon; without a place auto is 45", .commands = DRAW | MODEL, .change = GN_CHANGE_LIVE, .offset = FIELD(sun.altitude_deg))
GN_OPTION(.name = "sun-turbidity", .key = "turbidity", .section = "sun", .kind = GN_KIND_NUMBER, .min = 2, .max = 10, .value = "T", .fallback = "3",
          .help = "haze of the air, by which a low sun is weak and red: 2 is very clear, 3 clear, 6 hazy", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(sun.turbidity))
GN_OPTION(.name = "sun-caption", .key = "caption", .section = "sun", .kind = GN_KIND_FLAG,
          .help = "write the date and the time under the picture: by the clock of time_zone, and by the sun at the place, as a sundial has it", .commands = KIOSK | BIT(RENDER), .change = GN_CHANGE_LIVE, .offset = FIELD(sun.caption))
GN_OPTION(.name = "sun-hours", .key = "hours", .section = "sun", .kind = GN_KIND_FLAG,
          .help = "show in false colours with a scale for how many hours of the day each surface sees the sun; they are gathered over some seconds while scene and camera stand, and until then the picture has the sun of noon", .commands = KIOSK, .change = GN_CHANGE_LIVE, .offset = FIELD(sun.hours))
/* the camera's place in place of its own; orbits are as in model-viewer */
GN_OPTION(.name = "camera-theta", .key = "theta", .section = "camera", .kind = GN_KIND_EV, .min = -360, .max = 360, .value = "auto|DEG", .unit = "degrees", .fallback = "auto",
          .help = "side from which the camera looks at its target: 0 from the front (+Z), 90 from +X; auto: as the camera stands", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(camera.theta_deg))
GN_OPTION(.name = "camera-phi", .key = "phi", .section = "camera", .kind = GN_KIND_EV, .max = 180, .value = "auto|DEG", .unit = "degrees", .fallback = "auto",
          .help = "height from which the camera looks: 0 from straight above, 90 level; auto: as the camera stands", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(camera.phi_deg))
GN_OPTION(.name = "camera-distance", .key = "distance", .section = "camera", .kind = GN_KIND_EV, .max = 1e6, .value = "auto|M", .unit = "metres", .fallback = "auto",
          .help = "distance from the camera to its target; auto: as the camera stands, and an added one as near as it shows all", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(camera.distance_m))
GN_OPTION(.name = "camera-target", .key = "target", .section = "camera", .kind = GN_KIND_POINT, .min = -1e6, .max = 1e6, .value = "auto|X,Y,Z", .unit = "metres", .fallback = "auto",
          .help = "point that the camera looks at; auto: that before it at the distance of the scene's centre", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(camera.target_m))
GN_OPTION(.name = "camera-fov", .key = "fov", .section = "camera", .kind = GN_KIND_EV, .min = 1, .max = 170, .value = "auto|DEG", .unit = "degrees", .fallback = "auto",
          .help = "vertical field of view of a perspective camera; of one with an aspectRatio in a picture of that shape", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(camera.fov_deg))
GN_OPTION(.name = "camera-phi-min", .key = "phi_min", .section = "camera", .kind = GN_KIND_NUMBER, .max = 180, .value = "DEG", .unit = "degrees", .fallback = "0",
          .help = "mouse and fingers take the camera no higher", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(camera.phi_min_deg))
GN_OPTION(.name = "camera-phi-max", .key = "phi_max", .section = "camera", .kind = GN_KIND_NUMBER, .max = 180, .value = "DEG", .unit = "degrees", .fallback = "180",
          .help = "mouse and fingers take the camera no lower; 90: not below the horizon", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(camera.phi_max_deg))
GN_OPTION(.name = "camera-distance-min", .key = "distance_min", .section = "camera", .kind = GN_KIND_EV, .max = 1e6, .value = "auto|M", .unit = "metres", .fallback = "auto",
          .help = "mouse and fingers take the camera no nearer", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(camera.distance_min_m))
GN_OPTION(.name = "camera-distance-max", .key = "distance_max", .section = "camera", .kind = GN_KIND_EV, .max = 1e6, .value = "auto|M", .unit = "metres", .fallback = "auto",
          .help = "mouse and fingers take the camera no farther", .commands = DRAW, .change = GN_CHANGE_LIVE, .offset = FIELD(camera.distance_max_m))
/* where it goes */
GN_OPTION(.name = "backend", .section = "display", .kind = GN_KIND_WORD, .choices = backends, .value = "NAME", .fallback = "auto",
          .help = "display backend", .commands = DRAW | BIT(DOCTOR) | BIT(LESSON), .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(display.backend))
GN_OPTION(.name = "card", .section = "display", .kind = GN_KIND_TEXT, .value = "NAME",
          .help = "the display's card, as in /dev/dri/by-path; without it, the first with a monitor", .commands = KIOSK | BIT(LESSON), .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(display.card))
GN_OPTION(.name = "render-node", .section = "display", .kind = GN_KIND_PATH, .value = "FILE",
          .help = "the GPU that draws, as in /dev/dri/by-path; without it, the one that goes with the card", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(display.render_node))
GN_OPTION(.name = "connector", .section = "display", .kind = GN_KIND_TEXT, .value = "NAME",
          .help = "the display's connector; without it, the first connected", .commands = KIOSK | BIT(LESSON), .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(display.connector))
GN_OPTION(.name = "display-mode", .key = "mode", .section = "display", .kind = GN_KIND_MODE, .min = 16, .max = 16384,
          .value = "WxH@HZ", .help = "the display's mode; without it, its current or preferred one up to --max-mode", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(display.mode))
GN_OPTION(.name = "max-mode", .section = "display", .kind = GN_KIND_MODE, .min = 16, .max = 16384, .value = "WxH@HZ",
          .fallback = "1920x1080@60", .help = "largest mode that is chosen automatically, in size and in pixels per second", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(display.max_mode))
GN_OPTION(.name = "modeline", .section = "display", .kind = GN_KIND_MODELINE, .value = "LINE",
          .help = "custom mode, as printed by cvt, without its name", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(display.modeline))
GN_OPTION(.name = "rotate", .section = "display", .kind = GN_KIND_CHOICE, .choices = turns, .value = "DEG", .unit = "degrees",
          .fallback = "0", .help = "rotate the picture clockwise", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(display.rotate_deg))
GN_OPTION(.name = "max-fps", .section = "display", .kind = GN_KIND_INT, .min = 1, .max = 1000, .value = "N", .unit = "frames per second",
          .help = "limit on the frame rate; without it, the display's refresh rate", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(display.max_fps))
GN_OPTION(.name = "range", .section = "display", .kind = GN_KIND_CHOICE, .choices = ranges, .value = "WHAT", .fallback = "auto",
          .help = "levels of the signal to the monitor: as the driver chooses, full, or limited to 16 to 235, as televisions have them", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(display.range))
GN_OPTION(.name = "console", .section = "display", .kind = GN_KIND_CHOICE, .choices = consoles, .value = "WHAT", .fallback = "open",
          .help = "keyboard of the text console under the screen: open, or locked, so that no key leads away from it (board/museum.md)", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(display.console_locked))
GN_OPTION(.name = "legacy", .section = "display", .kind = GN_KIND_FLAG,
          .help = "use legacy KMS instead of atomic", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .reopens = true, .offset = FIELD(display.legacy))
GN_OPTION(.name = "touch-rotate", .section = "display", .kind = GN_KIND_CHOICE, .choices = turns, .value = "DEG", .unit = "degrees", .fallback = "0",
          .help = "how a touch screen's glass is mounted on its panel, if it is turned clockwise against it; with rotate touches are turned anyway", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .offset = FIELD(display.touch_rotate_deg))
GN_OPTION(.name = "pixel-shift", .section = "display", .kind = GN_KIND_INT, .min = 0, .max = 64, .value = "PX", .unit = "pixels", .fallback = "0",
          .help = "move the picture by a pixel a minute, up to so many to each side, against burn-in; 0: do not", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .offset = FIELD(display.pixel_shift_px))
GN_OPTION(.name = "scale", .section = "display", .kind = GN_KIND_EV, .min = 0.5, .max = 1, .value = "auto|X", .fallback = "auto",
          .help = "draw the scene at this share of the screen's width and height, and scale it; texts stay sharp; auto: the largest that a GPU whose speed is known draws in one refresh of the screen, else in as few as it can; 1 with other GPUs", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .offset = FIELD(display.scale))
/* what a kiosk does by itself */
GN_OPTION(.name = "idle", .section = "kiosk", .kind = GN_KIND_CHOICE, .choices = idles, .value = "WHAT", .fallback = "none",
          .help = "after the idle timeout go to the first mode, or to the next", .commands = KIOSK, .change = GN_CHANGE_LIVE, .offset = FIELD(kiosk.idle))
GN_OPTION(.name = "idle-after", .section = "kiosk", .kind = GN_KIND_SECONDS, .min = 1, .max = 86400, .value = "S", .unit = "seconds",
          .fallback = "60", .help = "idle timeout", .commands = KIOSK, .change = GN_CHANGE_LIVE, .offset = FIELD(kiosk.idle_after_ns))
GN_OPTION(.name = "pointer", .section = "kiosk", .kind = GN_KIND_CHOICE, .choices = pointers, .value = "WHICH", .fallback = "touch",
          .help = "what turns the model on a screen without a desktop: touch screens, all (mice, too; none is drawn) or none", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .offset = FIELD(kiosk.pointer))
GN_OPTION(.name = "while-playing", .section = "kiosk", .kind = GN_KIND_CHOICE, .choices = playings, .value = "WHAT", .fallback = "act",
          .help = "what buttons do while play CLIP plays: act as usual (play starts the clip again), or ignore presses", .commands = KIOSK, .change = GN_CHANGE_LIVE, .offset = FIELD(kiosk.plays_alone))
GN_OPTION(.name = "fade", .section = "kiosk", .kind = GN_KIND_SECONDS, .max = 10, .value = "S", .unit = "seconds", .fallback = "0",
          .help = "duration of the fade between modes", .commands = KIOSK, .change = GN_CHANGE_LIVE, .offset = FIELD(kiosk.fade_ns))
GN_OPTION(.name = "clip-fade", .section = "kiosk", .kind = GN_KIND_SECONDS, .max = 10, .value = "S", .unit = "seconds", .fallback = ".3",
          .help = "how long the scene takes from the pose of some clips to that of others", .commands = KIOSK, .change = GN_CHANGE_LIVE, .offset = FIELD(kiosk.clip_fade_ns))
/* what a kiosk reads from outside, and what it reports */
GN_OPTION(.name = "socket", .section = "kiosk", .kind = GN_KIND_PATH, .value = "PATH",
          .help = "the socket that ctl connects to; without it /run/gnomon/ctl, else $XDG_RUNTIME_DIR/gnomon/ctl", .commands = BIT(SHOW) | BIT(CTL), .change = GN_CHANGE_RESTART, .offset = FIELD(kiosk.socket))
GN_OPTION(.name = "screenshots", .section = "kiosk", .kind = GN_KIND_PATH, .value = "DIR",
          .help = "folder that clients of the socket may have screenshots written to by the kiosk itself; without it, only gnomon ctl gets them", .change = GN_CHANGE_RELOAD, .offset = FIELD(kiosk.screenshots))
GN_OPTION(.name = "watch", .section = "kiosk", .kind = GN_KIND_FLAG,
          .help = "show the scene and this file again when they have changed and are completely written; an error in them changes nothing but the status", .commands = KIOSK, .change = GN_CHANGE_RELOAD, .offset = FIELD(kiosk.watch))
GN_OPTION(.name = "state", .section = "kiosk", .kind = GN_KIND_PATH, .choices = states, .value = "FILE|no", .fallback = "no",
          .help = "file in which mode, scene and counters outlast a restart; beside it there is FILE.2. A service has /var/lib/gnomon/state", .commands = KIOSK, .change = GN_CHANGE_RESTART, .offset = FIELD(kiosk.state))
GN_OPTION(.name = "content", .section = "kiosk", .kind = GN_KIND_PATH, .choices = states, .value = "DIR|no", .fallback = "no",
          .help = "folder in which gnomon take keeps what USB sticks bring; its kiosk.ini, or its scene, is laid over this file. A service has /var/lib/gnomon/content", .commands = KIOSK | BIT(TAKE), .change = GN_CHANGE_RELOAD, .offset = FIELD(kiosk.content))
GN_OPTION(.name = "captions", .section = "kiosk", .kind = GN_KIND_FLAG, .fallback = "yes",
          .help = "show the name of a mode when it is entered", .change = GN_CHANGE_LIVE, .offset = FIELD(kiosk.captions))
GN_OPTION(.name = "caption-seconds", .section = "kiosk", .kind = GN_KIND_SECONDS, .min = .1, .max = 60, .value = "S", .unit = "seconds",
          .fallback = "2", .help = "how long a caption is shown at least; one of many words is shown for 1 s and .35 s a word", .change = GN_CHANGE_LIVE, .offset = FIELD(kiosk.caption_ns))
/* when the screen is on */
GN_OPTION(.name = "hours", .key = "on", .section = "schedule", .kind = GN_KIND_HOURS, .value = "HOURS", .fallback = "always",
          .help = "hours of local time in which the screen is on, as mon-fri 08:00-20:00, sat 10:00-18:00; always on while the clock is not set", .change = GN_CHANGE_RELOAD, .offset = FIELD(schedule.on))
GN_OPTION(.name = "hours-off", .key = "off", .section = "schedule", .kind = GN_KIND_CHOICE, .choices = offs, .value = "HOW", .fallback = "dpms",
          .help = "outside of these hours switch the display off, or show black, for displays that do not come back; cec and cec-black also put a television into standby and bring it back, by CEC", .change = GN_CHANGE_RELOAD, .offset = FIELD(schedule.off))
GN_OPTION(.name = "cec-device", .section = "schedule", .kind = GN_KIND_PATH, .value = "PATH",
          .help = "the CEC adapter, as /dev/cec1; without it the one of the connector in use, else the first that has a television", .change = GN_CHANGE_RELOAD, .offset = FIELD(schedule.cec_device))
GN_OPTION(.name = "hours-wake", .key = "wake", .section = "schedule", .kind = GN_KIND_SECONDS, .min = 1, .max = 86400, .value = "S", .unit = "seconds", .fallback = "300",
          .help = "a button that is pressed outside of these hours switches the screen on, until this long after the last press", .change = GN_CHANGE_RELOAD, .offset = FIELD(schedule.wake_ns))
GN_OPTION(.name = "hours-dim", .key = "dim", .section = "schedule", .kind = GN_KIND_HOURS, .value = "HOURS", .fallback = "never",
          .help = "hours of local time in which the picture is darker while the screen is on; never while the clock is not set", .change = GN_CHANGE_RELOAD, .offset = FIELD(schedule.dim))
GN_OPTION(.name = "hours-dim-to", .key = "dim_to", .section = "schedule", .kind = GN_KIND_NUMBER, .min = .01, .max = 1, .value = "X", .fallback = ".3",
          .help = "share of the picture's light that is left in the darker hours", .change = GN_CHANGE_RELOAD, .offset = FIELD(schedule.dim_to))
GN_OPTION(.name = "hours-clock", .key = "clock", .section = "schedule", .kind = GN_KIND_CHOICE, .choices = clocks, .value = "WHICH", .fallback = "checked",
          .help = "checked: the clock counts as set once the network or a battery has set it; trusted: also otherwise, if it shows 2024 or later", .change = GN_CHANGE_RELOAD, .offset = FIELD(schedule.clock_trusted))
/* the command's own */
GN_OPTION(.name = "input-script", .kind = GN_KIND_PATH, .value = "FILE",
          .help = "press keys and buttons by this script: TIME_S down|up|click NAME a line", .commands = BIT(SHOW), .offset = FIELD(run.input_script))
GN_OPTION(.name = "config", .letter = 'c', .kind = GN_KIND_PATH, .value = "FILE",
          .help = "read this INI file", .commands = DRAW | BIT(INSPECT) | BIT(CTL) | BIT(TAKE), .offset = FIELD(run.config))
GN_OPTION(.name = "check", .kind = GN_KIND_PATH, .value = "FILE",
          .help = "check this INI file and the files it names, print the resulting settings", .commands = BIT(SHOW), .offset = FIELD(run.check))
GN_OPTION(.name = "here", .kind = GN_KIND_FLAG,
          .help = "with --check: also whether this machine has the lines, the connector, the mode and the map formats", .commands = BIT(SHOW), .offset = FIELD(run.here))
GN_OPTION(.name = "mode", .kind = GN_KIND_TEXT, .value = "NAME",
          .help = "start in this mode of the INI file, or with this technique", .commands = DRAW, .offset = FIELD(run.mode))
GN_OPTION(.name = "out", .letter = 'o', .kind = GN_KIND_PATH, .value = "FILE",
          .help = "write to this file; %04d in it becomes the number of the frame; of lesson: to this folder; of fit: a kiosk.ini, over no other one; of doctor: the file of --report", .commands = BIT(RENDER) | BIT(LESSON) | BIT(BAKE) | BIT(FIT) | BIT(DOCTOR) | BIT(DIAL), .offset = FIELD(run.out))
GN_OPTION(.name = "simplify", .kind = GN_KIND_NUMBER, .min = 0.001, .max = 1, .value = "RATIO", .fallback = "1",
          .help = "keep this share of each mesh's triangles, or more where it would move by over 1/50 of its size", .commands = BIT(BAKE), .offset = FIELD(run.simplify))
GN_OPTION(.name = "kind", .kind = GN_KIND_CHOICE, .choices = dial_kinds, .value = "KIND", .fallback = "horizontal",
          .help = "kind of sundial: a level plate, one on a wall, one parallel to the equator, or an ellipse of hours for a pin that is moved with the date", .commands = BIT(DIAL), .offset = FIELD(run.dial.kind))
GN_OPTION(.name = "latitude", .kind = GN_KIND_NUMBER, .min = -90, .max = 90, .value = "DEG", .unit = "degrees",
          .help = "latitude that the sundial is made for, positive to the north", .commands = BIT(DIAL), .offset = FIELD(run.dial.latitude_deg))
GN_OPTION(.name = "longitude", .kind = GN_KIND_NUMBER, .min = -180, .max = 180, .value = "DEG", .unit = "degrees",
          .help = "longitude of the sundial, positive to the east: with --meridian its hours are those of the clock, but for the equation of time", .commands = BIT(DIAL), .offset = FIELD(run.dial.longitude_deg))
GN_OPTION(.name = "meridian", .kind = GN_KIND_NUMBER, .min = -210, .max = 210, .value = "DEG", .unit = "degrees",
          .help = "meridian of the clock's time: 15 for each hour that it is ahead of UTC", .commands = BIT(DIAL), .offset = FIELD(run.dial.meridian_deg))
GN_OPTION(.name = "declination", .kind = GN_KIND_NUMBER, .min = -180, .max = 180, .value = "DEG", .unit = "degrees",
          .help = "where the wall of a vertical sundial faces: 0 south, 90 west, -90 east, 180 north; without it, south, and south of the equator north", .commands = BIT(DIAL), .offset = FIELD(run.dial.wall_deg))
GN_OPTION(.name = "width", .kind = GN_KIND_NUMBER, .min = .02, .max = 100, .value = "M", .unit = "metres", .fallback = ".3",
          .help = "width of the sundial's plate", .commands = BIT(DIAL), .offset = FIELD(run.dial.width_m))
GN_OPTION(.name = "rollback", .kind = GN_KIND_FLAG,
          .help = "show the content from before the last take; a second time: go forward again", .commands = BIT(TAKE), .offset = FIELD(run.rollback))
GN_OPTION(.name = "caption", .kind = GN_KIND_TEXT, .value = "TEXT",
          .help = "draw this text on the picture, as the kiosk does with an error", .commands = BIT(RENDER), .offset = FIELD(run.caption))
GN_OPTION(.name = "frames", .kind = GN_KIND_INT, .min = 1, .max = 1000000, .value = "N",
          .help = "number of frames; show exits after them", .commands = BIT(SHOW) | BIT(RENDER) | BIT(BENCH), .offset = FIELD(run.frames))
GN_OPTION(.name = "fps", .kind = GN_KIND_NUMBER, .min = .001, .max = 1000, .value = "F", .unit = "frames per second", .fallback = "60",
          .help = "step of time between frames; of fit: how many are wanted", .commands = BIT(RENDER) | BIT(FIT), .offset = FIELD(run.fps))
GN_OPTION(.name = "samples", .kind = GN_KIND_INT, .min = 1, .max = 65536, .value = "N", .unit = "points", .fallback = "64",
          .help = "points of a light's area that --shadow truth casts rays to; 1: its middle", .commands = BIT(RENDER), .offset = FIELD(run.samples))
GN_OPTION(.name = "plan", .kind = GN_KIND_FLAG,
          .help = "also print the plan of the first frame", .commands = BIT(RENDER), .offset = FIELD(run.plan))
GN_OPTION(.name = "diff", .kind = GN_KIND_PATH, .value = "FILE",
          .help = "write the difference: 8 times its size as .png, or with its sign as .pfm", .commands = BIT(COMPARE), .offset = FIELD(run.diff))
GN_OPTION(.name = "tolerance", .kind = GN_KIND_NUMBER, .max = 1e9, .value = "X", .fallback = "0.004",
          .help = "how much a channel may differ, where white is 1", .commands = BIT(COMPARE), .offset = FIELD(run.tolerance))
GN_OPTION(.name = "share", .kind = GN_KIND_NUMBER, .max = 100, .value = "PERCENT", .unit = "per cent", .fallback = "0",
          .help = "how many of the pixels may differ by more; else the exit status is 3", .commands = BIT(COMPARE), .offset = FIELD(run.share))
GN_OPTION(.name = "shadows", .kind = GN_KIND_FLAG,
          .help = "A and B are the visibility of a light, B by rays: also measure how torn (tear) and grainy (grain) the shadows of A look, in per cent per pixel", .commands = BIT(COMPARE), .offset = FIELD(run.shadows.measure))
GN_OPTION(.name = "distance", .kind = GN_KIND_PATH, .value = "FILE",
          .help = "with --shadows, distances in the same picture (--aov distance): shadows are not measured across edges of depth, and those on an unseen floor by themselves", .commands = BIT(COMPARE), .offset = FIELD(run.shadows.distance))
GN_OPTION(.name = "normal", .kind = GN_KIND_PATH, .value = "FILE",
          .help = "with --shadows, normals in the same picture (--aov normal): shadows are not measured across edges", .commands = BIT(COMPARE), .offset = FIELD(run.shadows.normal))
GN_OPTION(.name = "to-light", .kind = GN_KIND_POINT, .min = -1e6, .max = 1e6, .value = "auto|X,Y,Z", .fallback = "auto",
          .help = "with --normal, direction to the light: shadows count by how much of its light a surface gets, a level floor's being 1; auto: all count alike", .commands = BIT(COMPARE), .offset = FIELD(run.shadows.to_light))
GN_OPTION(.name = "truth", .kind = GN_KIND_TEXT, .value = "NAME",
          .help = "scene of the benchmark that the picture shows; without it, the scene that has the picture's name", .commands = BIT(SCORE), .offset = FIELD(run.truth))
GN_OPTION(.name = "benchmark", .kind = GN_KIND_PATH, .value = "DIR", .fallback = "assets/benchmark",
          .help = "folder of the benchmark's scenes and truths", .commands = BIT(SCORE), .offset = FIELD(run.benchmark))
GN_OPTION(.name = "reach", .kind = GN_KIND_NUMBER, .max = 1000, .value = "TEXELS", .unit = "texels", .fallback = "3",
          .help = "how far the shadow's filter reads to each side: so far from edges lit pixels must be fully lit", .commands = BIT(SCORE), .offset = FIELD(run.reach))
GN_OPTION(.name = "make-truth", .kind = GN_KIND_FLAG,
          .help = "cast the rays of the scene that --truth names, and write the truth beside it", .commands = BIT(SCORE), .offset = FIELD(run.make_truth))
GN_OPTION(.name = "json", .kind = GN_KIND_FLAG,
          .help = "print JSON", .commands = BIT(BENCH) | BIT(INSPECT) | BIT(FIT) | BIT(DOCTOR) | BIT(CTL) | BIT(COMPARE) | BIT(SCORE) | BIT(LESSON) | BIT(BAKE), .offset = FIELD(run.json))
GN_OPTION(.name = "for", .kind = GN_KIND_CHOICE, .choices = gpus, .value = "GPU", .fallback = "none",
          .help = "also print how long the GPU of this board takes for a frame at least, what bounds each pass and what to change; of fit: the board: pi4, pi5, g31, g52, g610, a618 or a660", .commands = BIT(INSPECT) | BIT(FIT) | BIT(BENCH), .offset = FIELD(run.on_gpu))
GN_OPTION(.name = "csv", .kind = GN_KIND_FLAG,
          .help = "print CSV: a line for each scene and technique, or picture and class", .commands = BIT(BENCH) | BIT(SCORE), .offset = FIELD(run.csv))
GN_OPTION(.name = "move-lights", .kind = GN_KIND_FLAG,
          .help = "move the lights a little in each frame: all maps are drawn again", .commands = BIT(BENCH), .offset = FIELD(run.move_lights))
GN_OPTION(.name = "move-casters", .kind = GN_KIND_FLAG,
          .help = "move what casts shadows a little in each frame", .commands = BIT(BENCH), .offset = FIELD(run.move_casters))
GN_OPTION(.name = "self-test", .kind = GN_KIND_FLAG,
          .help = "draw small scenes with every technique and compare them with the truth", .commands = BIT(DOCTOR), .offset = FIELD(run.self_test))
GN_OPTION(.name = "report", .kind = GN_KIND_FLAG,
          .help = "write all that doctor finds, its self-test and a bench into a file to be sent (-o; gnomon-report.json), without names, paths, addresses and serial numbers", .commands = BIT(DOCTOR), .offset = FIELD(run.report))
GN_OPTION(.name = "compare", .kind = GN_KIND_FLAG,
          .help = "print the files of --report as a table and, of two, what differs; exit status 3 if the second is worse", .commands = BIT(DOCTOR), .offset = FIELD(run.compare_reports))
GN_OPTION(.name = "stats", .kind = GN_KIND_FLAG,
          .help = "print a line a second: frames, what was missed, time to draw", .commands = BIT(SHOW), .offset = FIELD(run.stats))
GN_OPTION(.name = "verbose", .letter = 'v', .kind = GN_KIND_FLAG,
          .help = "when the command fails, print warnings and the source of a failed shader too", .commands = ANY, .offset = FIELD(run.verbose))
GN_OPTION(.name = "version", .letter = 'V', .kind = GN_KIND_FLAG,
          .help = "print the version", .commands = ANY, .offset = FIELD(run.version))
GN_OPTION(.name = "help", .letter = 'h', .kind = GN_KIND_FLAG,
          .help = "print this; after a command, what that command takes", .commands = ANY, .offset = FIELD(run.help))
GN_OPTION(.name = "help=all", .kind = GN_KIND_FLAG,
          .help = "the same with all options", .commands = ANY, .offset = FIELD(run.help_all))
