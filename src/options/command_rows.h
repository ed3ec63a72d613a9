/* The table of commands of the program, one row each: GN_COMMAND(ID, id, fields of struct
 * gn_command_row). Included to number the rows and their bits (table.h), to make them (table.c) and
 * to find their functions (cli/commands.h, main.c), hence without a guard. A row and the function
 * gn_cli_<id> make a command. */
/* clang-format off */
GN_COMMAND(AUTO, auto, .usage = "[OPTION..] [SCENE]", .what = "shows a scene: in a window, without a desktop full screen, else as gnomon.png",
           .examples = {"gnomon scene.glb", "gnomon --shadow cone --turntable 6 scene.glb"},
           .most = 1, .takes = "only one scene", .config = GN_CONFIG_FOUND, .lays_content = true, .handles_signals = true)
GN_COMMAND(SHOW, show, .name = "show", .usage = "show [OPTION..] [SCENE..]", .what = "the kiosk: full screen without a desktop, runs until SIGTERM or `gnomon ctl quit`",
           .examples = {"gnomon show -c kiosk.ini", "gnomon show --check kiosk.ini"},
           .most = GN_SCENES_MAX, .takes = "at most 16 scenes", .config = GN_CONFIG_KIOSK, .lays_content = true, .handles_signals = true)
GN_COMMAND(RENDER, render, .name = "render", .usage = "render [OPTION..] [SCENE] -o FILE", .what = "draws into a file: .png, .pfm, or frame-%04d.png with --frames",
           .examples = {"gnomon render scene.glb -o picture.png --size 1920x1080 --msaa 4", "gnomon render scene.glb -o frame-%04d.png --frames 100 --fps 25"},
           .most = 1, .takes = "only one scene")
GN_COMMAND(BENCH, bench, .name = "bench", .usage = "bench [OPTION..] [SCENE..]", .what = "measures: time per frame and pass, draws, triangles, bytes, first picture, memory",
           .examples = {"gnomon bench scene.glb --shadow pcf,cone,pcss", "gnomon bench scene.glb --frames 200 --json"},
           .most = GN_SCENES_MAX, .takes = "at most 16 scenes")
GN_COMMAND(INSPECT, inspect, .name = "inspect", .usage = "inspect [OPTION..] [SCENE]", .what = "lists a scene's contents, cost and problems",
           .examples = {"gnomon inspect scene.glb", "gnomon inspect scene.glb --for pi4 --size 1920x1080"},
           .most = 1, .takes = "only one scene")
GN_COMMAND(FIT, fit, .name = "fit", .usage = "fit [OPTION..] [SCENE] --for GPU", .what = "chooses settings with which a board reaches a frame rate; with -o as a kiosk.ini",
           .examples = {"gnomon fit scene.glb --for pi4 --size 1920x1080 -o kiosk.ini", "gnomon fit scene.glb --for g52 --fps 30 --shadow cone"},
           .most = 1, .takes = "only one scene")
GN_COMMAND(DOCTOR, doctor, .name = "doctor", .usage = "doctor [OPTION..] [REPORT..]", .what = "tests this machine and prints how to fix problems; compares reports",
           .examples = {"gnomon doctor --report -o machine.json", "gnomon doctor --compare before.json after.json"},
           .words = GN_WORDS_FILES, .most = GN_SCENES_MAX, .takes = "it takes no scene, and with --compare at most 16 reports", .words_with = "compare")
GN_COMMAND(CTL, ctl, .name = "ctl", .usage = "ctl [OPTION..] COMMAND [WORD..]", .what = "sends a command to a running kiosk",
           .examples = {"gnomon ctl mode Soft", "gnomon ctl set shadow pcss"},
           .words = GN_WORDS_REQUEST, .most = 1 + GN_CTL_WORDS_MAX, .takes = "quote what has spaces", .config = GN_CONFIG_OPTIONAL, .config_unless = "socket")
GN_COMMAND(COMPARE, compare, .name = "compare", .usage = "compare [OPTION..] A B", .what = "measures how much two pictures differ, .png or .pfm",
           .examples = {"gnomon compare a.png b.png --diff difference.png", "gnomon compare a.pfm truth.pfm --shadows --json"},
           .words = GN_WORDS_FILES, .least = 2, .most = 2, .expects = "two pictures, A and B", .takes = "it takes two pictures")
GN_COMMAND(SCORE, score, .name = "score", .usage = "score [OPTION..] PICTURE|FOLDER", .what = "measures shadows in pictures of the open benchmark, of any engine",
           .examples = {"gnomon score picture.pfm --truth field-sun-00", "gnomon score build/benchmark/pcf --csv"},
           .words = GN_WORDS_FILES, .most = 1, .takes = "it takes one picture or folder")
GN_COMMAND(LESSON, lesson, .name = "lesson", .usage = "lesson [OPTION..] list|NAME|all", .what = "shows a fault of shadows and its cures; with -o as a page of pictures and figures",
           .examples = {"gnomon lesson position", "gnomon lesson all -o lessons"},
           .words = GN_WORDS_LESSON, .least = 1, .most = 1, .expects = "list, all or the name of a lesson", .takes = "one lesson, or all", .config = GN_CONFIG_LESSON, .handles_signals = true)
GN_COMMAND(BAKE, bake, .name = "bake", .usage = "bake [OPTION..] SCENE -o FILE.glb", .what = "writes a scene as one small .glb that boards load and draw fast",
           .examples = {"gnomon bake scene.glb -o board.glb", "gnomon bake scan.obj -o board.glb --simplify 0.25 --texture-limit 1024"},
           .least = 1, .most = 1, .expects = "one scene", .takes = "only one scene")
GN_COMMAND(DIAL, dial, .name = "dial", .usage = "dial [OPTION..] --latitude DEG -o FILE", .what = "writes a sundial for a place: a .glb, or a pattern in .svg",
           .examples = {"gnomon dial --latitude 52.5 -o dial.glb", "gnomon dial --latitude 48.1 --kind vertical --declination 20 -o wall.svg"},
           .words = GN_WORDS_FILES, .most = 0, .takes = "it takes no scene")
GN_COMMAND(TAKE, take, .name = "take", .usage = "take [OPTION..] [FOLDER]", .what = "takes the folder gnomon of a USB stick over, for a kiosk that has [kiosk] content",
           .examples = {"gnomon take /media/stick", "gnomon take --rollback"},
           .words = GN_WORDS_FILES, .most = 1, .takes = "it takes one folder", .config = GN_CONFIG_FOUND, .config_unless = "content")
