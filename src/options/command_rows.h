/* The commands of the program: ROW(ID, id, members of struct gn_command_row..). A row and the
 * function gn_cli_<id>() of src/cli/<id>.c make a command. The bare one stands first. */
ROW(AUTO, auto, .usage = "[OPTION..] [SCENE]",
    .what = "shows a scene: in a window, without a desktop full screen, else as gnomon.png",
    .most = 1, .takes = "one scene", .of_scenes = true, .finds_config = "", .handles_signals = true,
    .examples = {"gnomon scene.glb", "gnomon --shadow cone --turntable 6 scene.glb"})
ROW(SHOW, show, .name = "show", .usage = "show [OPTION..] [SCENE..]",
    .what = "the kiosk: full screen without a desktop, runs until SIGTERM or `gnomon ctl quit`",
    .most = GN_SCENES_MAX, .takes = "at most 16 scenes", .of_scenes = true, .finds_config = "",
    .handles_signals = true,
    .examples = {"gnomon show -c kiosk.ini", "gnomon show --check kiosk.ini"})
ROW(RENDER, render, .name = "render", .usage = "render [OPTION..] [SCENE] -o FILE",
    .what = "draws into a file: .png, .pfm, or frame-%04d.png with --frames", .most = 1,
    .takes = "one scene", .of_scenes = true,
    .examples = {"gnomon render scene.glb -o picture.png --size 1920x1080 --msaa 4",
                 "gnomon render scene.glb -o frame-%04d.png --frames 100 --fps 25"})
ROW(BENCH, bench, .name = "bench", .usage = "bench [OPTION..] [SCENE..]",
    .what = "measures: time per frame and pass, draws, triangles, bytes, first picture, memory",
    .most = GN_SCENES_MAX, .takes = "at most 16 scenes", .of_scenes = true,
    .examples = {"gnomon bench scene.glb --shadow pcf,cone,pcss",
                 "gnomon bench scene.glb --frames 200 --json"})
ROW(INSPECT, inspect, .name = "inspect", .usage = "inspect [OPTION..] [SCENE]",
    .what = "lists a scene's contents, cost and problems", .most = 1, .takes = "one scene",
    .of_scenes = true, .examples = {"gnomon inspect scene.glb", "gnomon inspect scene.glb --json"})
ROW(DOCTOR, doctor, .name = "doctor", .usage = "doctor [OPTION..]",
    .what = "tests this machine and says how to fix problems", .takes = "no scene",
    .examples = {"gnomon doctor", "gnomon doctor --self-test"})
ROW(CTL, ctl, .name = "ctl", .usage = "ctl [OPTION..] COMMAND [WORD..]",
    .what = "talks to a running kiosk", .most = 1 + GN_CTL_WORDS_MAX, .takes = "a command",
    .finds_config = "socket", .examples = {"gnomon ctl mode Soft", "gnomon ctl set shadow pcss"})
ROW(COMPARE, compare, .name = "compare", .usage = "compare [OPTION..] A B",
    .what = "measures how much two pictures differ, .png or .pfm", .least = 2, .most = 2,
    .takes = "two pictures, A and B",
    .examples = {"gnomon compare a.png b.png --diff difference.png",
                 "gnomon compare a.pfm truth.pfm --json"})
ROW(SCORE, score, .name = "score", .usage = "score [OPTION..] PICTURE|FOLDER",
    .what = "measures shadows in pictures of the open benchmark, of any engine", .most = 1,
    .takes = "one picture or folder",
    .examples = {"gnomon score picture.pfm --truth field-sun-00",
                 "gnomon score build/benchmark/pcf --csv"})
ROW(LESSON, lesson, .name = "lesson", .usage = "lesson [OPTION..] list|NAME|all",
    .what = "shows a fault of shadows and its cures; with -o as a page of pictures and figures",
    .least = 1, .most = 1, .takes = "list, all or the name of a lesson", .handles_signals = true,
    .examples = {"gnomon lesson position", "gnomon lesson all -o lessons"})
ROW(BAKE, bake, .name = "bake", .usage = "bake [OPTION..] SCENE -o FILE.glb",
    .what = "writes a scene as one small .glb that boards load and draw fast", .least = 1,
    .most = 1, .takes = "one scene", .of_scenes = true,
    .examples = {"gnomon bake scene.glb -o board.glb",
                 "gnomon bake scan.obj -o board.glb --simplify 0.25 --texture-limit 1024"})
ROW(TAKE, take, .name = "take", .usage = "take [OPTION..] [FOLDER]",
    .what = "takes the folder gnomon of a USB stick over, for a kiosk that has [kiosk] content",
    .most = 1, .takes = "one folder", .finds_config = "content",
    .examples = {"gnomon take /media/stick", "gnomon take --rollback"})
