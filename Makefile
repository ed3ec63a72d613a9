# gnomon. `make help` says what there is. Non-recursive: sources are found, not listed; the goals
# that may have to install packages first do that, and then call this file again with READY=1.
VERSION := 0.2.0
CONFIG  ?= release
O       ?= build
PREFIX  ?= /usr/local
DATE     = $(shell sed -n 's/^\#\# $(VERSION) - //p' board/CHANGELOG.md)
# where the packages will be for everybody; nobody has published them yet
REPOSITORY ?= https://gnomon.example/debian
$(if $(word 2,$(O)),$(error O= is one folder without a space in its name, not "$(O)"))
HOSTCC  ?= cc
SUB      = $(MAKE) --no-print-directory \
           $(if $(findstring jobserver,$(MAKEFLAGS)),,-j$(shell nproc)) READY=1
Q       := $(if $(V),,@)
GOALS   := $(or $(MAKECMDGOALS),all)
BARE    := help clean deps format uninstall dist # goals that need neither a compiler nor a library

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
.SUFFIXES:
.PHONY: all no-import tests programs completion dist deb release repository image run check accept full check-deb check-release check-image check-gpu check-gpus check-modelviewer check-cycles check-tangents truth swim models benchmark benchmark-scenes pictures gallery contact-sheet sun-sheet screens \
        lessons book readme board-table options-page deps syntax lint lint-brief lint-changed format man install uninstall help clean FORCE

#: make            build/release/gnomon, gnomon-import, the default scene and assets/bench
#: make run        install what is missing, build, show the default scene
#: make check      before a commit: gcc, clang, ASan and UBSan, lint of what changed, quick tests
#: make accept     what check leaves out: long tests, machines, GPUs, lint of all
#: make full       the longest forms of all that, hours: once before a release
#: make check-NAME what accept runs of a folder of tests, of a configuration or of one test (tests/table): check-angle,
#:                 check-board, check-arm64, check-gpiod2, check-kms, check-test_cone; with GN_FULL=1 what full runs of it
#: make check-service
#:                 the packages as a service, in a machine with systemd; check-deb: the packages themselves
#: make check-gpu  the report of this machine's GPU (no display needed), which must pass, and its row of that table
#: make check-gpus every program on the compilers of GPUs that are not here, and its cost
#: make check-modelviewer
#:                 colours against model-viewer in Chromium, by npm, on the models of ../shared/assets
#: make check-cycles
#:                 models against Blender's Cycles, and model-viewer's; LIGHTS="FILE.hdr STOPS .."
#: make check-tangents
#:                 tangents against the reference algorithm, by npm
#: make truth      shadows against ray-traced truth, as a table; CSV=FILE: as CSV, too
#: make swim       shadows that swim while the camera or the sun moves slowly, as a table
#: make benchmark  the open benchmark (assets/benchmark): scenes, truths, the table of all techniques;
#:                 make benchmark-scenes: the scenes only
#: make readme     the table of techniques (src/shadow/README.md), measured
#: make options-page
#:                 the table of keys in src/options/README.md, from the table of options
#: make board-table
#:                 the tables in board/README.md: costs, after the model of src/cost; the reports of board/results
#: make pictures   the pictures of README.md, and how far they are from rays
#: make gallery    one scene with every technique and the truth, into assets/gallery
#: make models     default pictures of the models of ../shared/assets against the same by rays;
#:                 SHADOW=.. for another technique, GATHER=always: what stands still gathers
#: make contact-sheet
#:                 the modes of the default scene, gone through by keys, as one picture
#: make screens    the kiosk in every state at six sizes, into build/screens.png and build/screens
#: make sun-sheet  the shadow at nine hours of four dates as one picture; SCENE=FILE, SUN=LAT,LON, ZONE=, DATES=, HOURS=
#: make lessons    faults of shadows beside their cures, into build/lessons/index.html
#: make book       eight scenes, each by its configuration in assets/book, into build/book.png
#: make deps       install the packages that building, running and testing need (apt);
#:                 with CROSS= those that building for it needs
#: make lint       clang-tidy; make syntax: clang for its warnings; make format: clang-format, in place
#: make install    DESTDIR= PREFIX=/usr/local; make uninstall takes it away again
#: make deb        Debian packages of the last commit; make release: those of 12 and 13 for amd64 and arm64, notes and checksums;
#:                 make image: a card that starts with gnomon (board/image); make check-image starts it in QEMU
#:                 make repository KEY=ID: of these, an apt repository; make check-release: both, twice, and installed from
#: make tests, man, compile_commands.json, clean
#: CONFIG=release|debug|asan|cov  CROSS=aarch64-linux-gnu SYSROOT=DIR  CC=clang  WERROR=1  V=1
help:
	@sed -n 's/^#: //p' Makefile
clean:
	rm -rf $(O) compile_commands.json assets/sundial.glb assets/bench/*.glb assets/lessons assets/book/*.glb assets/benchmark/*.glb assets/benchmark/*.pfm
deps:
	@sh board/deps.sh $(if $(CROSS),build cross,build run test)
format:
	@clang-format --version | grep -q 'version 14' || { echo "make format needs clang-format 14: others change files that are right" >&2; exit 1; }
	clang-format -i $(wildcard src/*.c src/*/*.[ch] src/*/*/*.[ch] tests/*/*.[ch] assets/*.[ch] assets/book/*.[ch] src/import/draco.cc board/*/*.c)
uninstall:
	@DESTDIR='$(DESTDIR)' PREFIX='$(PREFIX)' sh board/install.sh uninstall
# the last commit's files, with its time: the same bytes wherever they are packed
DIST := $(O)/gnomon-$(VERSION).tar.gz
dist:
	@mkdir -p $(O)
	git -c tar.umask=0022 archive --format=tar --prefix=gnomon-$(VERSION)/ HEAD | gzip -9n > $(DIST)

# goals that tests/table is for, and the sets of packages (board/deps.sh) that goals install first, beside `build` and `run`
MACHINES    := check-board check-arm64 check-gpiod2 check-service accept full
TABLED      := $(filter-out check-deb check-release check-image check-gpu check-gpus check-modelviewer check-cycles check-tangents,$(filter check check-% accept full,$(GOALS)))
IN_test     := $(TABLED) check-modelviewer check-cycles check-tangents truth swim models benchmark benchmark-scenes pictures gallery contact-sheet sun-sheet screens book readme
IN_board    := $(MACHINES)
IN_board-arm64 := $(MACHINES)
IN_gpus     := check-gpus accept full
IN_deb      := deb release repository check-deb check-release check-service full
IN_deb-test := check-deb check-release check-service full
IN_image    := image release check-image check-release
IN_image-test := check-image
BOOT := $(if $(READY),,$(filter run deb release repository image lessons check-deb check-release check-image check-gpus $(IN_test),$(GOALS)))
ifneq ($(BOOT),)
$(BOOT):
	@sh board/deps.sh build run $(foreach s,test board board-arm64 gpus deb deb-test image image-test,$(if $(filter $@,$(IN_$s)),$s))
	@+$(SUB) $@
$(filter-out $(BOOT) $(BARE),$(GOALS)):
	@+$(SUB) $@
else ifneq ($(filter-out $(BARE),$(GOALS)),)

# ---- the compiler and its flags ------------------------------------------------------------
CC      := $(if $(filter default undefined,$(origin CC)),$(if $(CROSS),$(CROSS)-)gcc,$(CC)) \
           $(if $(SYSROOT),--sysroot=$(SYSROOT))
AR      := $(if $(CROSS),$(CROSS)-)ar
B       := $(O)/$(if $(CROSS),$(CROSS)-)$(if $(findstring clang,$(CC)),clang-)$(CONFIG)
ifdef CROSS
PKG_CONFIG_LIBDIR ?= $(SYSROOT)/usr/lib/$(CROSS)/pkgconfig:$(SYSROOT)/usr/share/pkgconfig
PKG     := PKG_CONFIG_LIBDIR=$(PKG_CONFIG_LIBDIR) $(if $(SYSROOT),PKG_CONFIG_SYSROOT_DIR=$(SYSROOT)) pkg-config
endif
PKG     ?= pkg-config
PKGS    := jansson libpng libturbojpeg inih zlib
HEADERS := egl glesv2 cglm libdrm gbm
NEEDED  := $(PKGS) $(HEADERS) $(if $(filter tests programs syntax $(IN_test),$(GOALS)),cmocka)
MISSING := $(shell for p in $(NEEDED); do $(PKG) --exists $$p 2> /dev/null || echo $$p; done)
$(if $(MISSING),$(error Not found by $(PKG): $(MISSING). Try: make deps$(if $(CROSS), CROSS=$(CROSS))))
# FreeType draws the texts on the picture; without it they are in the font inside the program
PKGS    += $(shell $(PKG) --exists freetype2 2> /dev/null && echo freetype2)
# pictures of textures in WebP
PKGS    += $(shell $(PKG) --exists libwebp 2> /dev/null && echo libwebp)
# those in KTX2 that zstd has compressed
PKGS    += $(shell $(PKG) --exists libzstd 2> /dev/null && echo libzstd)
# gnomon-import is a program of its own, for those who have assimp or, by C++, draco
has      = $(shell $(PKG) --exists $(1) 2> /dev/null && echo y)
CXX     := $(if $(filter default undefined,$(origin CXX)),$(if $(CROSS),$(CROSS)-)$(if $(findstring clang,$(CC)),clang++,g++),$(CXX)) \
           $(if $(SYSROOT),--sysroot=$(SYSROOT))
ASSIMP  := $(call has,assimp)
DRACO   := $(if $(shell $(CXX) -std=c++17 -E -include draco/compression/decode.h -x c++ /dev/null > /dev/null 2>&1 && echo y),-ldraco -lstdc++)
OF_ASSIMP := $(addprefix src/import/,folder_io.c light.c material.c matrix.c mesh.c mtl.c normals.c obj.c picture.c ply.c scene.c texture.c)
IMPORT_C := $(if $(ASSIMP)$(DRACO),$(filter-out src/import/$(if $(ASSIMP),scene_none.c) $(if $(ASSIMP),,$(OF_ASSIMP)) \
             $(if $(DRACO),src/import/draco_none.c),$(sort $(wildcard src/import/*.c))))

takes    = $(shell $(CC) -Werror -O2 $(1) -x c -c -o /dev/null -include stdlib.h /dev/null \
             2> /dev/null && echo $(1))
HARDEN   = -fstack-protector-strong -fPIE $(or $(call takes,-D_FORTIFY_SOURCE=3),\
             -D_FORTIFY_SOURCE=2) $(or $(call takes,-fcf-protection),\
             $(call takes,-mbranch-protection=standard))
SANITIZE := -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
# no path of the build in it: two folders give the same bytes
CFLAGS_release = -O2 -g -DNDEBUG $(HARDEN) -ffile-prefix-map=$(CURDIR)=.
CFLAGS_debug   = -Og -g
CFLAGS_asan    = -O1 -g1 $(SANITIZE)
CFLAGS_cov     = -O0 -g --coverage
# of the tests' own files, nearly half of all: what the optimizer would take there is more than they run for
TESTS_release  = -O1
TESTS_asan     = -Og
LDFLAGS_release = -pie -Wl,-z,relro,-z,now
LDFLAGS_asan    = $(SANITIZE) -Wl,--export-dynamic-symbol=dlclose
LDFLAGS_cov     = --coverage
$(if $(CFLAGS_$(CONFIG)),,$(error CONFIG is release, debug, asan or cov, not $(CONFIG)))

# texts for people are cut on purpose: no -Wformat-truncation
WARN    := -Wall -Wextra -Wstrict-prototypes -Wmissing-prototypes -Wvla \
           $(call takes,-Wno-format-truncation)
ALL_CFLAGS := -std=c11 -D_GNU_SOURCE -DGL_GLES_PROTOTYPES=0 -DCGLM_ALL_UNALIGNED \
           -Isrc -Ishaders_es -I$(B)/gen $(WARN) -ffp-contract=off -fno-math-errno $(CFLAGS_$(CONFIG)) \
           $(shell $(PKG) --cflags $(PKGS) $(HEADERS) $(if $(ASSIMP),assimp)) $(CPPFLAGS) $(CFLAGS)
# a compiler for this machine looks for libraries at home first, whatever its sysroot
OF_ROOT := $(if $(SYSROOT), -L$(SYSROOT)/usr/lib/$(CROSS))
ALL_LDFLAGS := $(LDFLAGS_$(CONFIG)) $(LDFLAGS)$(OF_ROOT)
LIBS    := $(shell $(PKG) --libs $(PKGS)) -ldl -lm -lpthread
COMPILE  = $(CC) $(ALL_CFLAGS) $(if $(WERROR),-Werror) -MMD -MP

# ---- what there is to build ----------------------------------------------------------------
# x.c needs the package x and x_none.c stands in for it: the list of such pairs
OPTIONAL := src/display/osmesa:osmesa src/display/window/window:glfw3 src/caption/font_file:freetype2 \
            src/caption/shaper:raqm \
            src/image/webp_read:libwebp src/image/webp_write:libwebp \
            src/image/zstd:libzstd \
            src/core/syscall_filter:libseccomp
without  = $(foreach p,$(OPTIONAL),$(if $(shell $(PKG) --exists $(lastword $(subst :, ,$(p))) \
             2> /dev/null && echo y),$(firstword $(subst :, ,$(p)))_none.c,\
             $(firstword $(subst :, ,$(p))).c))
# libgpiod has two interfaces, and one file for each; gpio_none.c stands in for both
GPIOD   := $(firstword $(subst ., ,$(shell $(PKG) --modversion libgpiod 2> /dev/null)))
GPIO_C  := $(if $(filter 1 2,$(GPIOD)),gpiod$(GPIOD).c,gpio_none.c)
GPIO_LIBS := $(if $(filter 1 2,$(GPIOD)),$(shell $(PKG) --libs libgpiod))
# gnomon-import alone filters its system calls, and a test
SECCOMP_LIBS := $(shell $(PKG) --libs libseccomp 2> /dev/null)
# meshes compressed by meshoptimizer; its Debian packages have no .pc
MESHOPT := $(shell $(CC) -E -include meshoptimizer.h -x c /dev/null > /dev/null 2>&1 && echo -lmeshoptimizer)
LIBS    += $(MESHOPT)
unused  := $(without) src/scene/gltf/$(if $(MESHOPT),meshopt_none.c,meshopt.c) src/bake/$(if $(MESHOPT),reorder_none.c,reorder.c) $(addprefix src/input/,$(filter-out $(GPIO_C),gpiod1.c gpiod2.c gpio_none.c))
SRC     := $(filter-out $(unused) src/import/%,$(sort $(wildcard src/*/*.c src/*/*/*.c)))
TESTS_C := $(sort $(filter-out tests/board/% tests/gpus/% tests/import/% tests/angle/strict.c,$(wildcard tests/*/*.c)))
PROG_C  := $(foreach d,unit plan image fuzz kms angle modelviewer cycles fidelity tangents,$(filter tests/$d/test_% tests/$d/tool_%,$(TESTS_C)))
PROGS   := $(addprefix $(B)/tests/,$(notdir $(PROG_C:.c=)))
LIB     := $(B)/libgnomon.a
TESTLIB := $(B)/libgntest.a
BIN     := $(B)/gnomon
IMPORT  := $(if $(IMPORT_C),$(B)/gnomon-import,no-import)
OBJ      = $(patsubst %.c,$(B)/obj/%.o,$(1))
SCENES  := $(if $(wildcard assets/make_sundial.c),assets/sundial.glb assets/bench/yard.glb) \
           $(if $(wildcard assets/make_bench.c),assets/bench/s1.glb assets/bench/s2.glb)
LESSONS := $(patsubst %,assets/lessons/%.glb,solids hut sheets lattice lean plates thin far position form unseen lights model)
BOOK    := watch room carousel foliage product architecture studio window
SELFTEST := $(foreach s,box ball fence lattice tilt stack lamp,$(addprefix $(O)/selftest/$s,.glb .truth))
EMBED   := $(sort $(wildcard shaders_es/* shaders_es/*/*)) $(filter assets/sundial.glb,$(SCENES)) \
           $(SELFTEST) $(LESSONS) $(O)/studio.env $(O)/programs.cost board/README.md board/use.md board/wall.md board/report.md assets/SCENES.md src/shadow/README.md
EMBED   := $(foreach f,$(EMBED),$(if $(filter .glsl .vert .frag .glb .truth .env .cost .md,$(suffix $f)),$f))

# not out of a library: another one's dlclose would be found first
KEEP    := $(if $(filter asan,$(CONFIG)),$(call OBJ,tests/unit/keep_modules.c))

COMPLETION := $(addprefix $(O)/completion/gnomon.,bash zsh fish)

all: $(BIN) $(IMPORT) $(SCENES) man completion $(O)/gnomon.svg
# what tests use: the sanitizers look at none of it but a library that gnomon-import loads
HELPERS := $(if $(ASSIMP),$(B)/tests/hostile_assimp.so) $(if $(filter asan,$(CONFIG)),,$(filter $(B)/tests/tool_%,$(PROGS)) $(O)/host/make_truth $(O)/host/make_book \
           $(addprefix $(B)/tests/,test_penumbra firstflip.so keyboard touchscreen television angle/libEGL.so.1))
programs: $(BIN) $(IMPORT) $(SCENES) $(HELPERS) $(PROGRAMS)
tests: programs $(PROGS)
man: $(O)/gnomon.1 $(O)/gnomon.ini.5
completion: $(COMPLETION)

$(BIN): $(call OBJ,src/main.c) $(KEEP) $(LIB)
	@echo "link $@"
	$(Q)$(CC) $(ALL_CFLAGS) $(ALL_LDFLAGS) -o $@ $^ $(GPIO_LIBS) $(LIBS)
$(B)/gnomon-import: $(call OBJ,$(IMPORT_C)) $(if $(DRACO),$(B)/obj/src/import/draco.o) $(LIB)
	@echo "link $@"
	$(Q)$(CC) $(ALL_CFLAGS) $(ALL_LDFLAGS) -o $@ $^ $(if $(ASSIMP),$(shell $(PKG) --libs assimp)) $(DRACO) $(SECCOMP_LIBS) $(LIBS)
no-import:
	@echo 'no gnomon-import, so no OBJ, FBX, STL, PLY, DAE, no Draco: it needs libassimp-dev or libdraco-dev (make deps)'
$(LIB): $(call OBJ,$(SRC)) $(B)/obj/gen/embedded.o
$(TESTLIB): $(call OBJ,$(filter-out $(PROG_C) tests/unit/keep_modules.c,$(TESTS_C)))
$(LIB) $(TESTLIB): $(B)/sources
	$(Q)rm -f $@.new && $(AR) rcs $@.new $(filter %.o,$^) && mv $@.new $@
$(B)/obj/%.o: %.c $(B)/flags | $(B)/gen/config.h $(B)/gen/poisson.h $(B)/gen/rays.h
	@mkdir -p $(@D) && echo "cc   $<"
	$(Q)$(COMPILE) $(if $(filter tests/%,$<),$(TESTS_$(CONFIG)) -Itests) -c -o $@ $<
$(B)/obj/src/import/draco.o: src/import/draco.cc $(B)/flags
	@mkdir -p $(@D) && echo "c++  $<"
	$(Q)$(CXX) -std=c++17 -Isrc -Wall -Wextra $(CFLAGS_$(CONFIG)) $(if $(filter asan,$(CONFIG)),-fno-sanitize=vptr) $(CPPFLAGS) $(CXXFLAGS) $(if $(WERROR),-Werror) -MMD -MP -c -o $@ $<
$(B)/obj/gen/embedded.o: $(B)/gen/embedded.c $(B)/flags
	@mkdir -p $(@D) && echo "cc   $<"
	$(Q)$(COMPILE) -c -o $@ $<
# hundreds of programs that are only run here: by the linker that takes half the time, where it is there
LINKER  := $(if $(CROSS),,$(if $(shell command -v ld.lld 2> /dev/null),-fuse-ld=lld))
define program
$(B)/tests/$(basename $(notdir $(1))): $(call OBJ,$(1)) $(KEEP) $(TESTLIB) $(LIB)
	@mkdir -p $$(@D) && echo "link $$@"
	$(Q)$$(CC) $$(ALL_CFLAGS) $$(ALL_LDFLAGS) $$(LINKER) -o $$@ $$^ -lcmocka $$(GPIO_LIBS) $$(SECCOMP_LIBS) $$(LIBS)
endef
$(foreach c,$(PROG_C),$(eval $(call program,$(c))))

# what is built for GPUs that are not here has no more in it than it needs
$(B)/tests/tool_gpus: $(call OBJ,$(filter-out %/ident.c,$(wildcard tests/gpus/*.c)) \
                        tests/unit/gltf_maker.c tests/unit/scene_check.c) $(LIB)
	@mkdir -p $(@D) && echo "link $@"
	$(Q)$(CC) $(ALL_CFLAGS) $(ALL_LDFLAGS) -o $@ $^ $(GPIO_LIBS) $(LIBS)
$(B)/tests/firstflip.so: tests/board/firstflip.c
$(B)/tests/ident.so: tests/gpus/ident.c
$(B)/tests/hostile_assimp.so: tests/import/hostile_assimp.c
$(B)/tests/firstflip.so $(B)/tests/ident.so $(B)/tests/hostile_assimp.so: $(B)/flags
	@mkdir -p $(@D) && echo "link $@"
	$(Q)$(CC) -std=c11 -D_GNU_SOURCE -O2 $(WARN) $(if $(WERROR),-Werror) -fPIC -shared \
	    $(shell $(PKG) --cflags libdrm $(if $(ASSIMP),assimp)) $(OF_ROOT) -o $@ $(filter %.c,$^) -ldl
$(B)/tests/keyboard $(B)/tests/touchscreen $(B)/tests/television: $(B)/tests/%: tests/board/%.c $(B)/flags
	@mkdir -p $(@D) && echo "link $@"
	$(Q)$(CC) -std=c11 -D_GNU_SOURCE -O2 $(WARN) $(if $(WERROR),-Werror) $(OF_ROOT) -o $@ $<

# linked with a library of the name of ANGLE's that holds nothing, so that building needs none of ANGLE
$(B)/tests/angle/libEGL.so.1: tests/angle/strict.c $(B)/flags
	@mkdir -p $(@D) && echo "link $@"
	$(Q)$(CC) -shared -Wl,-soname,libEGL.so -o $(@D)/empty -x c /dev/null
	$(Q)$(CC) -std=c11 -D_GNU_SOURCE -DGL_GLES_PROTOTYPES=0 -O2 $(WARN) $(if $(WERROR),-Werror) -fPIC -shared \
	    $(shell $(PKG) --cflags egl glesv2) -o $@ $< -Wl,--no-as-needed $(@D)/empty -ldl
	$(Q)ln -sf libEGL.so.1 $(@D)/libGLESv2.so.2

# files that change only when what they say does: the flags, the list of sources, the configuration
define keep
@mkdir -p $(@D) && printf '%b\n' '$(1)' | cmp -s - $@ || printf '%b\n' '$(1)' > $@
endef
$(B)/flags: FORCE
	$(call keep,$(shell $(CC) --version | head -n 1) $(CC) $(ALL_CFLAGS) $(TESTS_$(CONFIG)) $(ALL_LDFLAGS) $(LINKER) $(GPIO_LIBS) $(SECCOMP_LIBS) $(LIBS))
$(B)/sources: FORCE
	$(call keep,$(SRC) $(IMPORT_C) $(TESTS_C) $(EMBED))
$(B)/gen/config.h: FORCE
	$(call keep,#define GN_VERSION "$(VERSION)"\n#define GN_PREFIX "$(PREFIX)"\n#define GN_HAVE_OSMESA $(if \
	    $(filter %/osmesa.c,$(without)),0,1))
$(B)/gen/rays.h: FORCE # what is kept of rays is of these sources
	$(call keep,#define GN_RAYS_SOURCES "$(shell cat src/truth/*.[ch] src/scene/*.h | cksum)")
$(B)/gen/poisson.h: $(O)/host/make_poisson
	@mkdir -p $(@D)
	$(Q)$< > $@
$(B)/gen/embedded.c: $(O)/host/embed $(B)/sources $(EMBED)
	$(Q)$< $(foreach f,$(EMBED),$(patsubst $(O)/%,%,$(patsubst shaders_es/%,%,\
	    $(patsubst assets/%,%,$f)))=$f) > $@

# ---- programs that run while building, and what they make ----------------------------------
HOST     = $(HOSTCC) -std=c11 -D_GNU_SOURCE -O2 -Wall -Wextra -Isrc -Iassets -I$(B)/gen -o $@ \
           $(filter %.c,$^) $(HOST_LIBS) -lm
ASSET_C := $(filter-out assets/make_%,$(wildcard assets/*.c)) $(wildcard src/shape/*.c)
HOST_ASSETS := $(patsubst assets/%.c,$(O)/host/%,$(wildcard assets/make_*.c))
MAN_C   := $(filter-out $(patsubst %,src/options/%.c,args change content file ini lesson),$(wildcard src/options/*.c)) \
           $(addprefix src/,cli/help.c core/arena.c core/err.c core/key.c core/text.c \
           core/terminal.c frame/caps.c display/kms/modeline.c scene/limits.c core/memory.c shadow/moments.c shadow/technique.c)
$(O)/host/embed: board/host/embed.c
$(O)/host/man $(O)/host/completion: $(O)/host/%: board/host/%.c $(MAN_C) $(wildcard src/*/*.h src/*/*/*.h) | $(B)/gen/config.h
$(O)/host/man $(O)/host/completion: HOST_LIBS = $(shell pkg-config --cflags libdrm)
$(HOST_ASSETS): HOST_LIBS = $(shell pkg-config --cflags --libs jansson libpng)
$(HOST_ASSETS): $(O)/host/%: assets/%.c $(ASSET_C) $(wildcard assets/*.h src/shape/*.h) src/core/file.h
$(O)/host/make_book: $(wildcard assets/book/*.c assets/book/*.h)
$(O)/host/make_studio: $(wildcard src/environment/*.c) $(addprefix src/,image/hdr_read.c core/arena.c core/err.c core/hash.c core/text.c) \
    $(wildcard src/environment/*.h)
$(O)/host/embed $(O)/host/man $(O)/host/completion $(HOST_ASSETS):
	@mkdir -p $(@D) && echo "host $@"
	$(Q)$(HOST)
$(O)/programs.cost: board/programs.awk $(wildcard tests/gpus/budget/*)
	@mkdir -p $(@D)
	$(Q)LC_ALL=C awk -f $^ > $@.tmp && mv $@.tmp $@
assets/sundial.glb assets/bench/yard.glb: $(O)/host/make_sundial
	@mkdir -p $(@D)
	$(Q)$< $(if $(filter %/yard.glb,$@),yard,garden) $@.tmp && mv $@.tmp $@
assets/bench/%.glb: $(O)/host/make_bench
	@mkdir -p $(@D)
	$(Q)$< $* $@.tmp && mv $@.tmp $@
$(O)/studio.env: $(O)/host/make_studio
	$(Q)$< $@.tmp && mv $@.tmp $@
assets/lessons/%.glb: $(O)/host/make_lessons
	@mkdir -p $(@D)
	$(Q)$< $* $@.tmp && mv $@.tmp $@
assets/book/%.glb: $(O)/host/make_book
	$(Q)$< $* $@.tmp && mv $@.tmp $@
$(O)/selftest/%.glb $(O)/selftest/%.truth: $(O)/host/make_selftest
	@mkdir -p $(@D)
	$(Q)$< $* $(basename $@)
$(O)/gnomon.1 $(O)/gnomon.ini.5: $(O)/host/man
	$(Q)$< $(@F) > $@
$(COMPLETION): $(O)/host/completion
	@mkdir -p $(@D)
	$(Q)$< $(subst .,,$(suffix $@)) > $@
$(O)/gnomon.svg: board/desktop/icon.sh
	$(Q)sh $< > $@

# ---- checks --------------------------------------------------------------------------------
# tests/table has what the goals run, and for which configurations; each is built as build_CONFIGURATION says.
# For another Debian or processor nothing is built where its packages cannot be had: then its tests say so, and skip.
BOARD_NEEDS := $(addprefix $(B)/,gnomon tests/firstflip.so tests/keyboard tests/touchscreen tests/television)
GPUS_NEEDS  := $(addprefix $(B)/,gnomon tests/tool_gpus tests/ident.so)
GPIOD2_NEEDS := $(BOARD_NEEDS) $(addprefix $(B)/tests/,test_gpio test_lines test_input test_gesture test_replay test_doctor_input)
build_release = $(SUB) WERROR=1 CONFIG=release PROGRAMS='$(filter $(O)/release/tests/%,$(RUNS))' all programs
build_asan    = $(SUB) WERROR=1 CONFIG=asan PROGRAMS='$(filter $(O)/asan/tests/%,$(RUNS))' programs
build_service = $(build_release) && $(SUB) deb
for_arm64     = { ! command -v aarch64-linux-gnu-gcc > /dev/null || ! root=$$($(1) tests/board/sysroot.sh arm64) || \
                $(SUB) CFLAGS=-g0 CROSS=aarch64-linux-gnu SYSROOT=$$root $(2); }
build_arm64   = $(call for_arm64,,needs-board)
build_gpus    = $(call for_arm64,FOR=gpus,WERROR=1 CONFIG=debug needs-gpus)
build_gpiod2  = { ! root=$$(SUITE=trixie tests/board/sysroot.sh) || $(SUB) CFLAGS=-g0 WERROR=1 CROSS=$$($(CC) -dumpmachine) SYSROOT=$$root needs-gpiod2; }
needs-board: $(BOARD_NEEDS)
needs-gpus: $(GPUS_NEEDS)
needs-gpiod2: $(GPIOD2_NEEDS)

run: all
	$(BIN)
lint_check  = $(SUB) lint-changed
lint_accept = $(SUB) lint-brief
lint_full   = $(SUB) lint && $(SUB) CC=clang WERROR=1 CONFIG=debug tests
$(TABLED):
	$(eval RUNS := $(shell O='$(O)' tests/goal.sh $(if $(filter check-%,$@),$(if $(GN_FULL)$(filter check-service,$@),full,accept) $(@:check-%=%),$@)))
	+@$(foreach c,$(patsubst CONFIGURATION=%,%,$(sort $(filter CONFIGURATION=%,$(RUNS)))),$(build_$c) &&) $(or $(lint_$@),:)
	@tests/run.sh $(RUNS)
check-gpus:
	+@$(build_gpus)
	@tests/run.sh BUILD=$(O)/aarch64-linux-gnu-debug tests/gpus/gpus.sh
check-modelviewer: $(BIN) $(B)/tests/tool_modelviewer $(B)/tests/tool_sheet $(O)/host/make_studio
	GNOMON=$(BIN) BUILD=$(B) tests/modelviewer/modelviewer.sh
check-cycles: $(BIN) $(B)/tests/tool_cycles $(O)/host/make_studio
	GNOMON=$(BIN) BUILD=$(B) tests/cycles/cycles.sh $(LIGHTS)
check-tangents: $(B)/tests/tool_tangents
	BUILD=$(B) tests/tangents/tangents.sh
# the table of keys in src/options/README.md
options-page: $(O)/host/man
	sh tests/options_page.sh $< > src/options/README.md.new && mv src/options/README.md.new src/options/README.md
board-table: $(BIN)
	for table in cost_table results; do sh board/$$table.sh $< board/README.md > board/README.md.new && mv board/README.md.new board/README.md || exit; done
check-gpu: $(BIN)
	GNOMON=$< BUILD=$(B) tests/gpu.sh
readme: $(B)/tests/tool_readme $(BIN) $(O)/host/make_truth $(SCENES)
	sh tests/image/readme.sh $<
pictures: $(B)/tests/tool_sheet $(BIN) assets/book/studio.glb assets/book/product.glb
	GNOMON=$(BIN) BUILD=$(B) O=$(O) tests/image/pictures.sh
gallery: $(B)/tests/tool_gallery $(BIN)
	@mkdir -p assets/gallery
	$< assets/gallery
lessons: $(BIN)
	$< lesson all -o $(O)/lessons
# each scene by its own configuration; the sheet has half their size
book: $(B)/tests/tool_sheet $(BIN) $(BOOK:%=assets/book/%.glb)
	GNOMON=$(BIN) BUILD=$(B) tests/image/book.sh $(O)/book.png $(BOOK)
# the kiosk in each state, at six sizes
screens: $(B)/tests/test_screens $(B)/tests/tool_sheet $(SCENES)
	@rm -rf $(O)/screens && mkdir -p $(O)/screens/whole
	SCREENS=$(O)/screens $<
	$(B)/tests/tool_sheet $(O)/screens.png 6 $(O)/screens/*.png
contact-sheet: $(B)/tests/tool_sheet $(BIN)
	BUILD=$(B) GNOMON=$(BIN) tests/image/accept_terminal.sh $(O)/contact-sheet.png
sun-sheet: $(B)/tests/tool_sheet $(BIN)
	BUILD=$(B) GNOMON=$(BIN) $(foreach v,SCENE SUN ZONE DATES HOURS SIZE,$(if $($v),$v='$($v)')) tests/image/sun_sheet.sh $(O)/sun-sheet.png
truth: $(B)/tests/tool_truth $(BIN) $(O)/host/make_truth
	$< $(if $(CSV),--csv $(CSV))
swim: $(B)/tests/tool_swim $(BIN)
	$<
models: $(B)/tests/tool_models $(BIN)
	@mkdir -p $(O)/models
	GNOMON=$(BIN) $(if $(GATHER),GATHER=$(GATHER)) $< ../shared/assets $(O)/models $(SHADOW)
# GN_UPDATE=1: writes the hashes of what was made
benchmark-scenes: $(B)/tests/tool_benchmark $(O)/host/make_truth
	BUILD=$(B) $< scenes assets/benchmark
	cd assets/benchmark && $(if $(GN_UPDATE),sha256sum *.glb > SHA256SUMS,grep '[.]glb$$' SHA256SUMS | sha256sum --quiet -c)
benchmark: benchmark-scenes $(BIN)
	GNOMON=$(BIN) BUILD=$(B) $(B)/tests/tool_benchmark truths assets/benchmark
	cd assets/benchmark && $(if $(GN_UPDATE),sha256sum *.pfm >> SHA256SUMS,grep '[.]pfm$$' SHA256SUMS | sha256sum --quiet -c)
	@mkdir -p $(O)/benchmark
	GNOMON=$(BIN) BUILD=$(B) $(B)/tests/tool_benchmark run assets/benchmark $(O)/benchmark $(TECHNIQUE)
# clang looks at all sources and builds nothing; its stamps know the headers. clang-tidy follows them:
# lint is all of it, lint-changed what has changed since it passed and, where it never ran, what
# differs from origin's branch (a fresh clone has no such). lint-brief, for accept, is all of it with an analyzer that looks
# at a sixth of the paths, in a quarter of the time; it has stamps of its own.
ifeq ($(if $(findstring clang,$(CC)),$(CONFIG)),debug)
TIDY    := src/main.c $(SRC) $(IMPORT_C)
SYNTAX  := $(TIDY) $(filter-out $(if $(ASSIMP),,tests/import/%),$(wildcard tests/*/*.c board/host/*.c assets/*.c assets/book/*.c))
stamps   = $(patsubst %.c,$(B)/obj/%.$(1),$(2))
syntax: $(call stamps,syntax,$(SYNTAX))
CLANG_TIDY = clang-tidy --quiet --warnings-as-errors='*' $(1) -- $(filter-out -f% -Wno%,$(ALL_CFLAGS))
lint: $(call stamps,tidy,$(TIDY))
lint-brief: $(call stamps,brief,$(TIDY))
lint-changed: syntax
	+@$(SUB) syntax $(wildcard $(call stamps,tidy,$(TIDY))) $$(tests/changed.sh $(B)/obj $(TIDY) | sed 's,\(.*\)c$$,$(B)/obj/\1tidy,')
$(B)/obj/%.syntax: %.c $(B)/flags | $(B)/gen/config.h $(B)/gen/poisson.h $(B)/gen/rays.h
	@mkdir -p $(@D) && echo "clang $<"
	$(Q)$(subst -I/usr/,-isystem /usr/,$(COMPILE)) -Werror -Wreserved-identifier -Wreserved-macro-identifier -Itests -Iassets -fsyntax-only -MF $@.d -MT $@ $< && touch $@
$(B)/obj/%.tidy: $(B)/obj/%.syntax .clang-tidy
	@echo "tidy $*.c"
	$(Q)$(call CLANG_TIDY,$*.c) 2> $@.log || { cat $@.log; false; } && touch $@
$(B)/obj/%.brief: $(B)/obj/%.syntax .clang-tidy
	@echo "tidy $*.c, in brief"
	$(Q)$(call CLANG_TIDY,$*.c) -Xclang -analyzer-config -Xclang max-nodes=40000 2> $@.log || { cat $@.log; false; } && touch $@
else
syntax lint lint-brief lint-changed:
	+@$(SUB) CC=clang CONFIG=debug $@
endif
compile_commands.json: FORCE
	@for f in src/main.c $(SRC) $(IMPORT_C) $(TESTS_C); do printf \
	    '{"directory": "$(CURDIR)", "file": "%s", "command": "$(CC) $(ALL_CFLAGS) -Itests -c %s"},\n' \
	    $$f $$f; done | sed '1s/^/[\n/; $$s/,$$/\n]/' > $@

# ---- installation --------------------------------------------------------------------------
install: all
	@O='$(O)' B='$(B)' IMPORT='$(IMPORT_C)' VERSION='$(VERSION)' DATE='$(DATE)' DESTDIR='$(DESTDIR)' PREFIX='$(PREFIX)' \
	    sh board/install.sh install
deb: dist
	@O='$(O)' VERSION='$(VERSION)' sh board/deb.sh
release: dist assets/sundial.glb
	@O='$(O)' VERSION='$(VERSION)' sh board/release.sh
repository:
	@REPOSITORY='$(REPOSITORY)' KEY='$(KEY)' sh board/repository.sh $(O)/gnomon-$(VERSION) $(O)/repository
image: all
	@O='$(O)' VERSION='$(VERSION)' sh board/image/build.sh
check-image: all
	@O='$(O)' VERSION='$(VERSION)' tests/board/image.sh
check-release:
	@O='$(O)' VERSION='$(VERSION)' REPOSITORY='$(REPOSITORY)' tests/board/release.sh
check-deb: dist
	@O='$(O)' VERSION='$(VERSION)' tests/board/packages.sh

-include $(shell find $(B)/obj -name '*.d' 2> /dev/null)
endif
