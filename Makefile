# Relume. All output goes to $(BUILD). `make demo` and `make check` need no other set-up.
#   make                    build; lists missing packages, installs nothing
#   make demo               install what this needs; record, ray trace and score a real program
#   make check              install what tests need, run all of them on all cores; ONLY="part of a name" runs some
#   make deps               install the Debian packages of both; make deps-GROUP: of one group of packaging/deps.txt
#   make bench              compare the traversal kernels with Embree's
#   make show               print all figures with their bars
#   make install            into PREFIX (/usr/local), below DESTDIR; make uninstall reverses it
#   make deb                a Debian package, checked by lintian
#   V=1                     show commands
#   SAN=address,undefined   sanitizer build, in its own folder
#   BUILD=DIR               build elsewhere
SAN ?=
BUILD ?= build$(if $(SAN),/san)
# Tests use all cores unless -j is given.
ifneq ($(filter check,$(MAKECMDGOALS)),)
MAKEFLAGS += -j$(shell nproc)
endif
# HAVE exists once all packages that a build needs are installed. INSTALLING: groups (packaging/deps.txt) that the goals install.
HAVE := $(BUILD)/have
INSTALLING := $(if $(filter-out show-suites,$(filter bench check deps fuzz fuzz-keep golden-update show show-% test-programs,$(MAKECMDGOALS))),check) \
	$(filter deb picture,$(MAKECMDGOALS))
PYTHON := /usr/bin/python3
Q := $(if $(V),,@)
# PATH may have another python; the generators need only Debian's.

CFLAGS ?= -O2 -g
CXXFLAGS ?= -O2 -g
# To GCC { NULL } is a complete initializer; clang warns about missing fields.
WARNINGS := -Wall -Wextra $(if $(findstring clang,$(shell { $(CC) --version; } 2>/dev/null)),-Wno-missing-field-initializers)
SANFLAGS := $(if $(SAN),-fsanitize=$(SAN) -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
CPPFLAGS += -I. -I$(BUILD)/gen -isystem /usr/include/OpenEXR -isystem /usr/include/Imath -D_GNU_SOURCE -DCL_TARGET_OPENCL_VERSION=120
ALL_CFLAGS := -std=c11 $(WARNINGS) -Werror=override-init -Werror=incompatible-pointer-types -ffp-contract=off -fPIC -pthread -MMD -MP $(SANFLAGS) $(CFLAGS)
ALL_CXXFLAGS := -std=c++17 $(WARNINGS) -fPIC -pthread -MMD -MP $(SANFLAGS) $(CXXFLAGS)
LIBS_OIIO := -Wl,--as-needed -lOpenImageIO -lOpenImageIO_Util -lstdc++
LIBS := -Wl,--as-needed -lOpenEXRCore -lOpenCL -lsnappy -lpng -lbrotlidec -lz -ldeflate -lisal -lxxhash -lcyaml -lseccomp -ldl -lm -pthread

# The recorder is linked from few files, so that little of Relume runs inside the traced program. The sizes are shared.
RECORDER_SRC := $(wildcard capture/gen/*.c capture/client/*.c capture/gl/*.c capture/write/*.c)
RECORDER_GEN := tables/commands tables/enums thunks
RECORDER_OBJ := $(patsubst %.c,$(BUILD)/recorder/%.o,$(RECORDER_SRC) capture/format/sizes.c capture/format/reserve.c capture/format/ref_pack.c) \
	$(patsubst %,$(BUILD)/recorder/gen/%.o,$(RECORDER_GEN))
VISUAL_SRC := verbs/recording/visual.c
REPLAY_SRC := $(wildcard replay/*.c replay/*/*.c replay/*/*/*.c)
COMMAND_SRC := relume.c $(REPLAY_SRC) $(wildcard $(patsubst %,%/*.c,base capture capture/format ci scene scene/repair look look/* kernels/ref tracer/*)) \
	$(wildcard diff/*.c diff/*/*.c) $(filter-out $(VISUAL_SRC),$(wildcard verbs/*/*.c verbs/*/*/*.c))
COMMAND_GEN := $(BUILD)/gen/kernels.c $(BUILD)/gen/commands.c $(BUILD)/gen/handlers.c $(BUILD)/gen/page.c $(BUILD)/gen/manual.c $(BUILD)/gen/surfaces.c

COMMAND_OBJ := $(COMMAND_SRC:%.c=$(BUILD)/%.o) $(COMMAND_GEN:.c=.o)

# The bridge to OpenImageIO, loaded when a picture needs it, and the parts of the command that it calls.
OIIO_OBJ := $(addprefix $(BUILD)/,$(addprefix tracer/image/,oiio.o heads.o image.o pack.o exr_pack.o) base/err.o base/memory.o)

# Programs to record: plain OpenGL programs, built as anybody would build them.
CORPUS := $(patsubst %.c,$(BUILD)/%,$(wildcard corpus/*.c corpus/es/*.c corpus/glx/*.c corpus/wayland/*.c)) $(BUILD)/corpus/rooms
TESTS := $(patsubst %.c,$(BUILD)/%,$(wildcard tests/*/test_*.c tests/harness/fails.c) tests/bench/tiny.c tests/bench/translate.c tests/fuzz/drive.c tests/fuzz/make_seeds.c)

all: $(BUILD)/relume $(BUILD)/librelume.so $(BUILD)/librelume-rays.so $(BUILD)/relume-oiio.so $(BUILD)/visual/libGL.so.1

# Snappy and its C++ inside, as in the recorder: looking up C++ symbols takes the loader a third of the start-up time.
$(BUILD)/relume: $(COMMAND_OBJ)
	$(Q)$(CXX) $(ALL_CXXFLAGS) $(LDFLAGS) $(if $(SAN),,-static-libstdc++ -static-libgcc) -o $@ $^ $(LIBS:-lsnappy=-l:libsnappy.a)

# The same code without its main function, for other programs: verbs/query/relume-rays.h.
RAYS_OBJ := $(filter-out $(BUILD)/relume.o,$(COMMAND_OBJ))
$(BUILD)/librelume-rays.so: $(RAYS_OBJ) verbs/query/exports.map
	$(Q)$(CXX) $(ALL_CXXFLAGS) $(LDFLAGS) -shared -static-libstdc++ -static-libgcc -Wl,-Bsymbolic -Wl,-soname,librelume-rays.so \
		-Wl,--version-script=verbs/query/exports.map -o $@ $(RAYS_OBJ) $(LIBS:-lsnappy=-l:libsnappy.a)

$(BUILD)/%.o: %.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(ALL_CFLAGS) -c -o $@ $<

$(BUILD)/%.o: %.cpp $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CXX) $(CPPFLAGS) $(ALL_CXXFLAGS) -c -o $@ $<

$(BUILD)/relume-oiio.so: $(OIIO_OBJ)
	$(Q)$(CXX) $(ALL_CXXFLAGS) $(LDFLAGS) -shared -Wl,-Bsymbolic -o $@ $^ $(LIBS_OIIO) $(LIBS)

# Replaces libGL, under its name, for glretrace.
$(BUILD)/visual/libGL.so.1: $(VISUAL_SRC) $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(filter-out $(SANFLAGS),$(ALL_CFLAGS)) $(LDFLAGS) -shared -fPIC -Wl,-soname,libGL.so.1 -o $@ $< \
		-Wl,--no-as-needed -l:libGLX.so.0 -l:libOpenGL.so.0 -ldl

# The recorder runs in other programs: no sanitizer, no exported symbols but the commands of GL, Snappy and its
# C++ linked in, no symbol of its own that the program could replace.
RECORDER_CFLAGS = $(filter-out $(SANFLAGS),$(ALL_CFLAGS)) -I$(BUILD)/recorder/gen -fvisibility=hidden
$(BUILD)/librelume.so: $(RECORDER_OBJ) capture/gen/exports.map
	$(Q)$(CXX) -shared $(LDFLAGS) -static-libstdc++ -static-libgcc -Wl,-Bsymbolic -Wl,-z,defs -Wl,--version-script=capture/gen/exports.map \
		-o $@ $(RECORDER_OBJ) -l:libsnappy.a -ldl -pthread

# The recorder for 32-bit programs, beside the other one where the loader looks for either (capture/record.c).
DEPS_i386 := gcc-multilib g++-multilib libsnappy-dev:i386 libx11-6:i386 libgl1:i386 libgl1-mesa-dri:i386 libglu1-mesa:i386 libglut3.12:i386 mesa-utils-bin:i386
I386_CFLAGS = $(filter-out $(SANFLAGS),$(ALL_CFLAGS)) -m32 -D_FILE_OFFSET_BITS=64 -Wno-psabi -I$(BUILD)/recorder/gen -fvisibility=hidden
I386_OBJ := $(patsubst $(BUILD)/recorder/%,$(BUILD)/i386/%,$(RECORDER_OBJ))
LIBRELUMES := $(BUILD)/lib/i386-linux-gnu/librelume.so $(BUILD)/lib/x86_64-linux-gnu/librelume.so
i386: $(LIBRELUMES) $(addprefix $(BUILD)/i386/,windows two_triangles spheres tricks)

# Both architectures must have the same package version: if the newest is not available for both (an archive's index may lag), use that of the
# release itself. No installed package may be removed for this: apt then reports the conflict.
$(BUILD)/deps.i386: Makefile | $(HAVE)
	@mkdir -p $(@D)
	@if [ "$$(dpkg-query -W -f '$${db:Status-Status}\n' $(DEPS_i386) 2>/dev/null | grep -cx installed)" != $(words $(DEPS_i386)) ]; then \
		echo "installing from Debian, i386 added: $(DEPS_i386) (see $@.log)"; \
		[ "$$(id -u)" = 0 ] || sudo=sudo; \
		had=$$(dpkg --print-foreign-architectures | grep -cx i386); \
		export DEBIAN_FRONTEND=noninteractive; \
		install="$$sudo apt-get -q -y --no-remove --no-install-recommends install $(DEPS_i386)"; \
		{ $$sudo dpkg --add-architecture i386 && { $$sudo apt-get -q update; $$install || $$install -t $$(. /etc/os-release; echo $$VERSION_CODENAME); }; } \
			>$@.log 2>&1 || { tail -n 20 $@.log; [ $$had = 1 ] || $$sudo dpkg --remove-architecture i386; exit 1; }; \
	fi
	@touch $@

$(BUILD)/i386/gen/%.o: $(BUILD)/recorder/gen/%.c $(BUILD)/flags | $(BUILD)/deps.i386
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(I386_CFLAGS) -O2 -g0 -c -o $@ $<

$(BUILD)/i386/%.o: %.c $(BUILD)/recorder/gen/stamp $(BUILD)/flags | $(BUILD)/deps.i386
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(I386_CFLAGS) -O2 -c -o $@ $<

$(BUILD)/lib/i386-linux-gnu/librelume.so: $(I386_OBJ) capture/gen/exports.map
	@mkdir -p $(@D)
	$(Q)$(CXX) -m32 -shared $(LDFLAGS) -static-libstdc++ -static-libgcc -Wl,-Bsymbolic -Wl,-z,defs \
		-Wl,--version-script=capture/gen/exports.map -o $@ $(I386_OBJ) -l:libsnappy.a -ldl -pthread

$(BUILD)/lib/x86_64-linux-gnu/librelume.so: $(BUILD)/librelume.so
	@mkdir -p $(@D)
	$(Q)ln -sf ../../librelume.so $@

# Programs for the test of the 32-bit recorder and for show-reach.
$(BUILD)/i386/windows: tests/real/windows.c tests/trace/window.h | $(BUILD)/deps.i386
	@mkdir -p $(@D)
	$(Q)$(CC) -m32 -std=c11 $(WARNINGS) -O2 -D_GNU_SOURCE -DGL_GLEXT_PROTOTYPES -I. -o $@ $< -l:libGL.so.1 -l:libX11.so.6 -lm -pthread

$(BUILD)/i386/%: corpus/%.c corpus/program.h | $(BUILD)/deps.i386
	@mkdir -p $(@D)
	$(Q)$(CC) -m32 -std=c11 $(WARNINGS) -O2 -D_GNU_SOURCE -o $@ $< -l:libglut.so.3.12 -l:libGLU.so.1 -l:libGL.so.1 -lm

# Windows programs, for Wine: unchanged corpus programs, also as 32-bit ones, and one with Windows' own kinds of windows.
WINDOWS := $(addprefix $(BUILD)/windows/,two_triangles.exe spheres.exe tricks.exe wgl.exe)
WINE32 := $(BUILD)/wine32/usr/lib/wine/wine
WINDOWS32 := $(foreach p,two_triangles spheres tricks,$(BUILD)/windows32/$p.exe $(BUILD)/i386/sse/$p) $(WINE32)
MINGW = -w64-mingw32-gcc -std=gnu11 $(WARNINGS) -O2 -ffp-contract=off
windows: $(WINDOWS) $(WINDOWS32)

$(BUILD)/windows/wgl.exe: tests/real/wgl.c | $(BUILD)/deps.windows
	@mkdir -p $(@D)
	$(Q)x86_64$(MINGW) -o $@ $< -lopengl32 -lgdi32

$(BUILD)/windows/%.exe: corpus/%.c corpus/program.h corpus/windows/GL/glut.h | $(BUILD)/deps.windows
	@mkdir -p $(@D)
	$(Q)x86_64$(MINGW) -Icorpus/windows -o $@ $< -lglu32 -lopengl32 -lgdi32

# 32-bit Windows programs have twins on Linux, as Mesa's 32-bit pixels differ from its 64-bit ones. Both use SSE: the x87 rounds to
# different widths on the two systems.
SSE := -msse2 -mfpmath=sse
$(BUILD)/i386/sse/%: corpus/%.c corpus/program.h | $(BUILD)/deps.i386
	@mkdir -p $(@D)
	$(Q)$(CC) -m32 $(SSE) -std=c11 $(WARNINGS) -O2 -D_GNU_SOURCE -o $@ $< -l:libglut.so.3.12 -l:libGLU.so.1 -l:libGL.so.1 -lm

$(BUILD)/windows32/%.exe: corpus/%.c corpus/program.h corpus/windows/GL/glut.h | $(BUILD)/deps.windows
	@mkdir -p $(@D)
	$(Q)i686$(MINGW) $(SSE) -Icorpus/windows -o $@ $< -lglu32 -lopengl32 -lgdi32

# Wine for both classes, in a folder. Debian's wine32 is unpacked, not installed: installing it needs half of i386, in the package versions of
# this system, which an archive may lack. It has the same version as the wine64 that starts it, and no fonts: with i386's FreeType it waits
# forever in NtGdiOpenDCW, recorded or not.
$(WINE32): | $(BUILD)/deps.windows $(BUILD)/deps.i386
	$(Q)rm -rf $(BUILD)/wine32 $(BUILD)/wine32.new && mkdir -p $(BUILD)/wine32.new
	$(Q)version=$$(dpkg-query -W -f '$${Version}' wine64) && cd $(BUILD)/wine32.new && \
		{ apt-get -q download wine32:i386=$$version libwine:i386=$$version >download.log 2>&1 || { cat download.log; exit 1; }; } && \
		for package in *.deb; do dpkg -x $$package . && rm $$package || exit 1; done
	$(Q)cp /usr/lib/wine/wine64 $(BUILD)/wine32.new/usr/lib/wine
	$(Q)cp /usr/lib/x86_64-linux-gnu/wine/i386-windows/zlib1.dll $(BUILD)/wine32.new/usr/lib/i386-linux-gnu/wine/i386-windows
	$(Q)mkdir $(BUILD)/wine32.new/usr/lib/x86_64-linux-gnu && ln -s /usr/lib/x86_64-linux-gnu/wine $(BUILD)/wine32.new/usr/lib/x86_64-linux-gnu/wine
	$(Q)mv $(BUILD)/wine32.new $(BUILD)/wine32

# Only the recorder with a sanitizer, for the threads test: it then needs a program linked with the sanitizer's runtime.
SANITIZED_CFLAGS = -std=c11 $(WARNINGS) -O1 -g -fPIC -pthread -fvisibility=hidden -fno-omit-frame-pointer -I$(BUILD)/recorder/gen
$(BUILD)/sanitized/%/librelume.so: $(RECORDER_OBJ) capture/gen/exports.map $(BUILD)/relume
	@mkdir -p $(@D)
	$(Q)cp $(BUILD)/relume $(@D)/relume
	$(Q)$(CC) $(CPPFLAGS) $(SANITIZED_CFLAGS) -fsanitize=$* -shared -Wl,-Bsymbolic -Wl,--version-script=capture/gen/exports.map -o $@ \
		$(RECORDER_SRC) capture/format/sizes.c capture/format/ref_pack.c $(patsubst %,$(BUILD)/recorder/gen/%.c,$(RECORDER_GEN)) -l:libsnappy.a -lstdc++ -ldl -pthread

$(BUILD)/sanitized/%/threads: tests/trace/threads.c tests/trace/window.h
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O1 -g -fsanitize=$* -D_GNU_SOURCE -DGL_GLEXT_PROTOTYPES -I. -o $@ $< -lGL -lX11 -ldl -lm -pthread

$(BUILD)/recorder/gen/stamp $(RECORDER_GEN:%=$(BUILD)/recorder/gen/%.c) &: capture/gen/gen.py capture/gen/registry.py capture/gen/overlay.txt | $(HAVE)
	@mkdir -p $(BUILD)/recorder/gen
	$(Q)$(PYTHON) -B capture/gen/gen.py capture/gen/overlay.txt $(BUILD)/recorder/gen
	@touch $(BUILD)/recorder/gen/stamp $(RECORDER_GEN:%=$(BUILD)/recorder/gen/%.c)

$(BUILD)/recorder/gen/%.o: $(BUILD)/recorder/gen/%.c $(BUILD)/flags
	$(Q)$(CC) $(CPPFLAGS) $(RECORDER_CFLAGS) -O2 -g0 -c -o $@ $<

$(BUILD)/recorder/%.o: %.c $(BUILD)/recorder/gen/stamp $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(RECORDER_CFLAGS) -c -o $@ $<

# Generated headers are built before files that include them; the .d files have the other dependencies.
GENERATED_H := $(BUILD)/gen/gl_tokens.h $(BUILD)/gen/layout.h $(BUILD)/gen/version_number.h
$(COMMAND_OBJ) $(TESTS:=.o): | $(GENERATED_H)
$(GENERATED_H): | $(HAVE)

$(BUILD)/gen/gl_tokens.h: replay/gen.py capture/gen/registry.py
	@mkdir -p $(@D)
	$(Q)$(PYTHON) -B replay/gen.py $@ tokens

$(BUILD)/gen/version_number.h: VERSION
	@mkdir -p $(@D)
	$(Q)printf '/* Made by the Makefile from VERSION. */\n#define RELUME_VERSION "%s"\n' "$$(cat $<)" >$@

# Members of the state machine that snapshots save: snapshots of another layout are not read (replay/index/layout.txt).
LAYOUT := replay/index/layout
$(BUILD)/gen/layout.h: $(LAYOUT).py $(LAYOUT).txt $(BUILD)/gen/gl_tokens.h
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) -std=c11 -E -P -MD -MP -MF $(@:.h=.dep) -MT $@ -include replay/index/snapshot_parts.h -x c - </dev/null | \
		$(PYTHON) -B $(LAYOUT).py $(LAYOUT).txt $@
-include $(BUILD)/gen/layout.dep

# Rewritten if a handler's line changes; left alone, and so not recompiled, if other lines do.
$(BUILD)/gen/commands.c $(BUILD)/gen/handlers.c: $(BUILD)/gen/%.c: replay/gen.py replay/overlay.txt capture/gen/overlay.txt capture/gen/registry.py $(REPLAY_SRC) | $(GENERATED_H)
	$(Q)$(PYTHON) -B replay/gen.py $@ $* replay/overlay.txt capture/gen/overlay.txt $(sort $(REPLAY_SRC))

$(BUILD)/gen/%.o: $(BUILD)/gen/%.c $(BUILD)/flags
	$(Q)$(CC) $(CPPFLAGS) $(ALL_CFLAGS) -c -o $@ $<

# Kernels are embedded in the command as text.
KERNELS := $(wildcard kernels/*/*.cl)
HOST_TEXTS := kernels/ref/host_builtins.h kernels/ref/hook_host.h # hooks of the reference device: tracer/hook/host.h
$(BUILD)/gen/kernels.c: kernels/embed.py $(KERNELS) $(HOST_TEXTS) | $(GENERATED_H)
	@mkdir -p $(@D)
	$(Q)$(PYTHON) kernels/embed.py $@ $(@:.c=.dep) . $(BUILD)/gen -- $(KERNELS) $(HOST_TEXTS)
-include $(BUILD)/gen/kernels.dep

# The report's page, as a C string.
$(BUILD)/gen/page.c: diff/report/page.html diff/report/page.js
	@mkdir -p $(@D)
	$(Q)(echo '#include "diff/report/report.h"'; echo 'const char report_page[] ='; \
		sed -e '/^\/\*SCRIPT\*\/$$/{r diff/report/page.js' -e 'd}' $< | sed 's/[\\"]/\\&/g; s/.*/"&\\n"/'; echo ';') >$@

# Texts of `relume help` about file formats, and examples.
$(BUILD)/gen/manual.c: packaging/manual.py | $(GENERATED_H)
	@mkdir -p $(@D)
	$(Q)$(PYTHON) -B $< $@ $(@:.c=.dep)
-include $(BUILD)/gen/manual.dep

# The page of relume look --sheet, as a C string.
$(BUILD)/gen/surfaces.c: verbs/render/surfaces.html
	@mkdir -p $(@D)
	$(Q)(echo '#include "verbs/render/surfaces.h"'; echo 'const char surfaces_page[] ='; sed 's/[\\"]/\\&/g; s/.*/"&\\n"/' $<; echo ';') >$@

# Rebuilt when flags change.
FLAGS := $(CC) $(CPPFLAGS) $(ALL_CFLAGS) $(CXX) $(ALL_CXXFLAGS)
ifneq ($(file <$(BUILD)/flags),$(FLAGS))
$(BUILD)/flags: FORCE
endif
$(BUILD)/flags: | $(HAVE)
	@mkdir -p $(@D)
	@echo '$(FLAGS)' >$@

# Nothing is compiled before the packages it needs are installed. `make` only lists missing ones; INSTALLING goals install them first.
$(HAVE): packaging/deps.txt | $(INSTALLING:%=$(BUILD)/deps.%)
	@mkdir -p $(@D)
	@packaging/deps.sh need build
	@touch $@

deps: $(BUILD)/deps.deps
deps-%: $(BUILD)/deps.% ;

$(BUILD)/deps.%: packaging/deps.txt
	@mkdir -p $(@D)
	@packaging/deps.sh install $* 2>$@.log || { tail -n 20 $@.log; exit 1; }
	@touch $@

# Debian programs, in addition to those of the group.
$(BUILD)/deps.lot $(BUILD)/deps.sweep $(BUILD)/deps.sweep-record: $(BUILD)/deps.%: packaging/deps.txt tests/show/more_programs.py | $(BUILD)/deps.check
	@packaging/deps.sh install $* -- $$($(PYTHON) -B tests/show/more_programs.py) 2>$@.log || { tail -n 20 $@.log; exit 1; }
	@touch $@

$(BUILD)/corpus/%: corpus/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O2 -MMD -MP -MF $@.d -MT $@ -o $@ $< -lglut -lGLU -lGL -lm

$(BUILD)/corpus/es/%: corpus/es/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O2 -MMD -MP -MF $@.d -MT $@ -o $@ $< -lEGL -lGLESv1_CM -lX11 -lm

$(BUILD)/corpus/glx/%: corpus/glx/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O2 -MMD -MP -MF $@.d -MT $@ -o $@ $< -lGL -lX11 -lm

$(BUILD)/corpus/wayland/%: corpus/wayland/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O2 -MMD -MP -MF $@.d -MT $@ -o $@ $< -lwayland-client -lwayland-egl -lEGL -lGL -lm

$(BUILD)/corpus/rooms: $(wildcard corpus/rooms/*.[ch]) corpus/program.h $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O2 -o $@ $(filter %.c,$^) -lglut -lGLU -lGL -lm

# Tests are linked with all of the command but its main function, and with the bridge directly.
$(BUILD)/parts.a: $(filter-out $(BUILD)/relume.o $(BUILD)/tracer/image/oiio_load.o,$(COMMAND_OBJ)) $(BUILD)/tracer/image/oiio.o
	@rm -f $@
	$(Q)$(AR) rcs $@ $^

$(BUILD)/tests/fuzz/test_stream: $(BUILD)/tests/fuzz/stream.o
$(BUILD)/tests/fuzz/test_calls $(BUILD)/tests/fuzz/test_pictures $(BUILD)/tests/fuzz/test_stream: $(BUILD)/tests/fuzz/calls.o $(BUILD)/gen/fuzz_commands.o
$(BUILD)/tests/%: $(BUILD)/tests/%.o $(BUILD)/parts.a
	$(Q)$(CXX) $(ALL_CXXFLAGS) -o $@ $(filter %.o,$^) $(filter-out $(NOT_LINKED),$(filter %.a,$^)) $(LIBS_OIIO) $(LIBS) $(LIBS_$(@F)) -lcheck -lsubunit -lm

LIBS_test_blend := -lEGL -lGL

# Rewrites recordings so that they draw the same picture by other calls.
$(BUILD)/tests/same/relations: $(patsubst %.c,$(BUILD)/%.o,$(filter-out tests/same/relations.c,$(wildcard tests/same/*.c)))

# Libraries and programs that tests preload or record: not linked with any part of Relume.
HELPERS := $(patsubst %.c,$(BUILD)/%.so,$(wildcard tests/real/*_shim.c) tests/real/failing_cl.c tests/check/host_cl.c) \
	$(patsubst %,$(BUILD)/tests/%,real/back real/blocking real/closer real/composed real/cracks real/deep real/depths real/elsewhere real/empty real/endless real/errors real/front real/greedy real/growing real/kdtree real/layers real/leaving real/linear real/moments real/moved real/multisampled real/objects real/parameters real/parting real/parts real/persistent real/pixels real/pixmaps real/projections real/readbacks real/recut real/samples real/shapes real/shared real/sheets real/shoal real/sizes real/stair real/sums real/surfaces real/targets real/textures real/turning real/units real/vertices real/windows bench/static_scene) \
	$(patsubst %.c,$(BUILD)/%,$(wildcard tests/real/panels/*.c tests/real/small/*.c)) \
	$(patsubst %.c,$(BUILD)/%,$(filter-out $(wildcard tests/trace/test_*.c),$(wildcard tests/trace/*.c)))

$(BUILD)/tests/%.so: tests/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O2 -D_GNU_SOURCE -shared -fPIC -o $@ $< -ldl

$(filter-out %.so,$(HELPERS)): $(BUILD)/%: %.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O2 -D_GNU_SOURCE -DGL_GLEXT_PROTOTYPES -I. -MMD -MP -MF $@.d -MT $@ -o $@ $< -lGL -lX11 -ldl -lm -pthread

# Randomly generated legacy programs.
$(BUILD)/tests/generated/program: $(wildcard tests/generated/*.[ch]) $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O2 -D_GNU_SOURCE -DGL_GLEXT_PROTOTYPES -I. -o $@ $(filter %.c,$^) -lGL -lX11 -lm

# Programs that check/test_host runs.
HOST_TESTS := $(addprefix $(BUILD)/tests/check/test_,rays camera shade compose)

# With ONLY, prerequisites of other tests are not built.
HARNESS := $(BUILD)/tests/harness/fails $(BUILD)/tests/bench/tiny $(BUILD)/tests/fuzz/drive $(HOST_TESTS)
BUILT_FOR_TESTS := $(HELPERS) $(BUILD)/tests/same/relations $(BUILD)/tests/generated/program $(addprefix $(BUILD)/tests/bench/,hits build queries)
check: all pages $(CORPUS) $(if $(ONLY),$(HARNESS) $(foreach part,$(ONLY),$(foreach t,$(TESTS),$(if $(findstring $(part),$(t:$(BUILD)/tests/%=%)),$t))),$(TESTS)) $(BUILT_FOR_TESTS)
	$(Q)$(PYTHON) tests/run.py $(BUILD) $(ONLY)

demo:
	@corpus/demo.sh $(BUILD)

# The picture at the top of README.md.
picture: all $(BUILD)/corpus/glx/marbles
	@corpus/picture.sh $(BUILD)

# Figures with their bars: each show-NAME writes $(BUILD)/show/NAME.json, and fails if a figure misses its bar. Group NAME of
# packaging/deps.txt lists packages that only it needs, NEEDS_NAME its build prerequisites; those ON_SCREEN need a display.
SHOWS := show-house show-rays show-rays-avx2 show-hits show-query show-build show-host show-metrics show-batch-faults show-device-faults
SCRIPTS := beyond bisect ci crashes cryptomatte devices export farm faults flaky frames fuzz generated hooks inject journeys kill look mutants oclgrind overhead page parity path photons reach reduce relit replay rooms same sandbox sanitize seek \
	film lot soak sweep sweep-record thesis
SCRIPT_bisect := bisection# a bisect.py would stand before Python's own
ON_SCREEN := ci crashes frames mutants replay
SHOWS += $(SCRIPTS:%=show-%)

show:
	@$(MAKE) -k --no-print-directory $(SHOWS); $(PYTHON) tests/show/table.py $(BUILD)/show

NEEDS_ci = $(HELPERS)
NEEDS_devices = $(HELPERS) $(BUILD)/show/devices/intel/ready
NEEDS_frames := $(BUILD)/tests/bench/frame_rays
NEEDS_generated := $(BUILD)/tests/generated/program
NEEDS_inject = $(HELPERS)
NEEDS_kill = $(HELPERS)
NEEDS_oclgrind := $(BUILD)/tests/bench/tiny
NEEDS_overhead = $(HELPERS)
NEEDS_photons := $(BUILD)/tests/truth/test_caustics
NEEDS_reach = $(WINDOWS) $(BUILD)/tests/real/deep
NEEDS_rooms := $(BUILD)/tests/unit/test_repair
NEEDS_same = $(HELPERS) $(BUILD)/tests/same/relations
NEEDS_sandbox = $(HELPERS)
NEEDS_mutants = $(HELPERS) $(BUILD)/tests/fuzz/drive $(BUILD)/tests/fuzz/make_seeds
NEEDS_soak = $(HELPERS)
NEEDS_sanitize := $(foreach s,thread address,$(BUILD)/sanitized/$s/librelume.so $(BUILD)/sanitized/$s/threads)

.SECONDEXPANSION:
$(SCRIPTS:%=show-%): show-%: all $$(CORPUS) $$(NEEDS_$$*) $(BUILD)/deps.$$*
	@$(if $(filter $*,$(ON_SCREEN)),tests/xvfb.sh) $(PYTHON) -B tests/show/$(or $(SCRIPT_$*),$(subst -,_,$*)).py $(BUILD) $(ONLY:%=--only %)

# Measures of the source: cycles, sizes, repetitions.
show-house: all
	@$(PYTHON) -B tests/house.py $(BUILD) --count --json $(BUILD)/show/house.json

# Benchmarks against Embree, which is linked only here: the traversal kernels (bench: without a bar), whole frames against the
# rays in them and a rasteriser, hits ray by ray and queries one by one (the tests of those names in tests/check run fewer), the builders of acceleration structures.
MODELS ?= ../shared/models
BENCHES := $(addprefix $(BUILD)/tests/bench/,embree frame_rays hits build queries)
$(BENCHES:=.o): | $(GENERATED_H)
$(addprefix $(BUILD)/tests/bench/,embree.o frame_rays.o): private ALL_CFLAGS += -O3 -march=native
$(BUILD)/tests/bench/build: $(BUILD)/tests/bench/embree_build.o
$(BUILD)/tests/bench/queries: $(BUILD)/tests/bench/brute.o
$(BENCHES): %: %.o $(BUILD)/parts.a
	$(Q)$(CXX) $(ALL_CXXFLAGS) -o $@ $(filter %.o,$^) $(BUILD)/parts.a -l$$(test -e /usr/include/embree4 && echo embree4 || echo embree3) $(LIBS_OIIO) $(LIBS)

bench: $(BUILD)/tests/bench/embree
	@$< --models $(MODELS) --json $(BUILD)/bench.json --command "make bench"

show-rays show-rays-avx2: $(BUILD)/tests/bench/embree
show-hits: $(BUILD)/tests/bench/hits
show-query: $(BUILD)/tests/bench/queries
show-build: $(BUILD)/tests/bench/build
# As on a processor without AVX-512: PoCL compiles for such a processor, and Embree is limited to AVX2.
show-rays-avx2: $(BUILD)/tests/real/avx2_shim.so
show-rays-avx2: NARROW = LD_PRELOAD=$(abspath $(BUILD)/tests/real/avx2_shim.so) POCL_CACHE_DIR=$(abspath $(BUILD)/tests/pocl-cache-avx2)
show-rays-avx2: BARS := --bars 1 --isa avx2
show-rays show-build: BARS := --bars 1
show-rays show-rays-avx2 show-hits show-query show-build:
	@mkdir -p $(BUILD)/show
	@$(NARROW) $< --models $(MODELS) $(BARS) --json $(BUILD)/show/$(@:show-%=%).json --command "make $@"

# PyPI packages in separate virtual environments: other implementations of metrics, and Intel's OpenCL.
$(BUILD)/show/venv/ready: | $(BUILD)/deps.metrics
	@$(PYTHON) -m venv $(@D) && $(@D)/bin/pip install -q flip-evaluator==1.7 scikit-image==0.26.0
	@touch $@

$(BUILD)/show/devices/intel/ready: | $(BUILD)/deps.devices
	@$(PYTHON) -m venv $(@D) && $(@D)/bin/pip install -q intel-opencl-rt==2026.2.0 intel-cmplr-lib-rt==2026.2.0
	@touch $@

SHOWS += show-denoise
$(BUILD)/show/denoise/venv/ready: | $(BUILD)/deps.denoise
	@$(PYTHON) -m venv $(@D) && $(@D)/bin/pip install -q flip-evaluator==1.7 pyoidn==2.5.1.0
	@touch $@

show-denoise: all $(BUILD)/show/denoise/venv/ready
	@$(BUILD)/show/denoise/venv/bin/python -B tests/show/denoise.py $(BUILD)

show-metrics: all $(CORPUS) $(BUILD)/tests/unit/test_metrics $(BUILD)/show/venv/ready
	@$(BUILD)/show/venv/bin/python -B tests/show/metrics.py $(BUILD)

# Kernels built for this processor with the freedoms of OpenCL C, compared with their C twins.
show-host: all $(HELPERS) $(HOST_TESTS) $(BUILD)/tests/bench/tiny
	@$(PYTHON) tests/check/test_host.py $(BUILD)

# Tests whose full runs take minutes: every OpenCL call fails once; a batch meets every fault.
show-device-faults show-batch-faults: show-%: all $(HELPERS)
	@tests/xvfb.sh $(PYTHON) tests/real/test_$(subst -,_,$*).py $(BUILD)

# Not part of `make show`: piglit takes 2 GB, and each target a quarter of an hour or more.
show-piglit-record show-piglit-parity: show-piglit-%: all $(BUILD)/deps.piglit
	@tests/xvfb.sh $(PYTHON) tests/show/piglit.py $(BUILD) $* $(ONLY)

# Piglit's tests of ARB programs and GLSL, Relume's own panels, and the cost of programs; ONLY=real: third-party programs.
show-programs: all $(HELPERS) $(CORPUS) $(BUILD)/tests/bench/translate $(BUILD)/deps.piglit $(if $(filter real,$(ONLY)),$(BUILD)/deps.programs)
	@tests/xvfb.sh $(PYTHON) -B tests/show/stages.py $(BUILD) $(ONLY)

# Not part of `make show`: puts faults into the sources, each behind a switch, and runs the tests; takes hours. Resumes where it was stopped.
TESTS_SECONDS ?=
test-programs: all $(TESTS) $(BUILT_FOR_TESTS)
show-tests: all
	@$(PYTHON) -B tests/show/tests.py $(BUILD) $(ONLY:%=--only %) $(TESTS_SECONDS:%=--seconds %)

# Not part of `make show`: the README's commands in bare chroots of Debian's releases, and arm64 under qemu-user.
# Needs root, and most of an hour for each; SUITE=NAME runs one.
SUITE ?=
show-suites: $(BUILD)/deps.suites $(if $(filter-out arm64,$(SUITE)),,all)
	@$(PYTHON) -B tests/show/suites.py $(BUILD) $(SUITE:%=--only %)

# libFuzzer under sanitizers, a target for each reader: tests/fuzz/fuzz_NAME.c. Findings worth keeping go into tests/fuzz/kept*.
FUZZ_SECONDS ?= 3600
FUZZ_CC ?= clang
FUZZ_CXX ?= clang++
FUZZ_TARGETS := $(patsubst tests/fuzz/fuzz_%.c,%,$(wildcard tests/fuzz/fuzz_*.c))
FUZZ_SRC := $(filter-out tracer/image/oiio_load.c $(VISUAL_SRC),$(wildcard $(patsubst %,%/*.c,base capture/format scene scene/repair look look/apply verbs/farm verbs/recording $(addprefix diff/,rules baseline score pictures) \
	$(addprefix tracer/,image device) kernels/ref))) $(addprefix tracer/accel/,blas_store.c bvh.c compress.c soup.c tree.c) $(REPLAY_SRC) verbs/render/stamp.c \
	$(addprefix capture/write/,pages.c values.c) $(addprefix tests/fuzz/,calls.c stream.c target.c)
FUZZ_GEN := $(patsubst $(BUILD)/%.c,$(BUILD)/fuzz/objects/%.o,$(filter-out %/page.c %/surfaces.c,$(COMMAND_GEN)) $(BUILD)/gen/fuzz_commands.c) $(BUILD)/fuzz/objects/gen/enums.o
FUZZ_OBJ := $(FUZZ_SRC:%.c=$(BUILD)/fuzz/objects/%.o) $(BUILD)/fuzz/objects/tracer/image/oiio.o $(FUZZ_GEN)
FUZZ_SAN := -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined
FUZZ_CFLAGS := $(CPPFLAGS) -I$(BUILD)/recorder/gen -O1 -g -ffp-contract=off -pthread -MMD -MP $(FUZZ_SAN)
$(BUILD)/fuzz/objects/%.o: %.c | $(GENERATED_H) $(BUILD)/deps.fuzz
	@mkdir -p $(@D)
	$(Q)$(FUZZ_CC) $(FUZZ_CFLAGS) -std=c11 -c -o $@ $<

$(BUILD)/fuzz/objects/%.o: %.cpp | $(BUILD)/deps.fuzz
	@mkdir -p $(@D)
	$(Q)$(FUZZ_CXX) $(FUZZ_CFLAGS) -std=c++17 -c -o $@ $<

$(BUILD)/fuzz/objects/gen/%.o: $(BUILD)/gen/%.c | $(BUILD)/deps.fuzz
	@mkdir -p $(@D)
	$(Q)$(FUZZ_CC) $(FUZZ_CFLAGS) -std=c11 -c -o $@ $<

$(BUILD)/fuzz/objects/gen/enums.o: $(BUILD)/recorder/gen/tables/enums.c | $(BUILD)/deps.fuzz
	@mkdir -p $(@D)
	$(Q)$(FUZZ_CC) $(FUZZ_CFLAGS) -std=c11 -c -o $@ $<

$(BUILD)/fuzz/parts.a: $(FUZZ_OBJ)
	@rm -f $@
	$(Q)$(AR) rcs $@ $^

$(FUZZ_TARGETS:%=$(BUILD)/fuzz/%): $(BUILD)/fuzz/%: $(BUILD)/fuzz/objects/tests/fuzz/fuzz_%.o $(BUILD)/fuzz/parts.a
	$(Q)$(FUZZ_CXX) -fsanitize=fuzzer,address,undefined -pthread -o $@ $^ $(LIBS_OIIO) $(LIBS)

# The same targets in one program without libFuzzer, for kept inputs and mutants; each gets another entry name. Linked with the same parts of the
# command as they are, so a file missing from FUZZ_SRC is a link error.
DRIVE_OBJ := $(patsubst %,$(BUILD)/tests/fuzz/targets/%.o,$(filter-out calls replay,$(FUZZ_TARGETS)))
$(BUILD)/tests/fuzz/targets/%.o: tests/fuzz/fuzz_%.c $(BUILD)/flags | $(GENERATED_H)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(ALL_CFLAGS) -DLLVMFuzzerTestOneInput=fuzz_$* -DLLVMFuzzerInitialize=begin_$* -I$(BUILD)/recorder/gen -c -o $@ $<
$(BUILD)/tests/fuzz/targets/recorder.o: | $(BUILD)/recorder/gen/stamp

$(BUILD)/tests/fuzz/drive: $(DRIVE_OBJ) $(BUILD)/tests/fuzz/target.o $(addprefix $(BUILD)/recorder/,capture/write/pages.o capture/write/values.o gen/tables/enums.o)
$(BUILD)/tests/fuzz/drive $(BUILD)/tests/fuzz/make_seeds: $(BUILD)/tests/fuzz/calls.o $(BUILD)/gen/fuzz_commands.o
$(BUILD)/tests/fuzz/drive: $(BUILD)/tests/fuzz/parts.a
$(BUILD)/tests/fuzz/drive: $(BUILD)/tests/fuzz/stream.o
$(BUILD)/tests/fuzz/drive: private NOT_LINKED := $(BUILD)/parts.a
$(BUILD)/tests/fuzz/parts.a: Makefile $(patsubst $(BUILD)/fuzz/objects/%,$(BUILD)/%,$(filter-out %/gen/enums.o $(BUILD)/fuzz/objects/capture/write/% $(BUILD)/fuzz/objects/tests/%,$(FUZZ_OBJ)))
	@rm -f $@
	$(Q)$(AR) rcs $@ $(filter %.o,$^)

$(BUILD)/gen/fuzz_commands.c: tests/fuzz/gen_commands.py replay/gen.py capture/gen/registry.py $(REPLAY_SRC) | $(GENERATED_H)
	$(Q)$(PYTHON) -B $< $@ $(sort $(REPLAY_SRC))

.PHONY: fuzz fuzz-keep
fuzz: all $(HELPERS) $(CORPUS) $(BUILD)/tests/fuzz/make_seeds $(FUZZ_TARGETS:%=$(BUILD)/fuzz/%)
	@tests/xvfb.sh tests/fuzz/campaign.py $(BUILD) run $(FUZZ_SECONDS) $(ONLY)

# Keeps small inputs: paths that only large ones reach are covered from recordings again.
fuzz-keep: $(FUZZ_TARGETS:%=$(BUILD)/fuzz/%)
	@tests/fuzz/campaign.py $(BUILD) keep $(ONLY)

# Only in a separate commit.
golden-update: all
	@$(PYTHON) tests/golden/test_golden.py --update

# Man pages and shell completion are made from the command's help texts and those about file formats.
$(BUILD)/pages/stamp: packaging/pages.py packaging/manual.py $(wildcard packaging/debian/changelog) $(BUILD)/relume
	$(Q)rm -rf $(@D)
	$(Q)$(PYTHON) -B packaging/pages.py $(BUILD)/relume $(@D)
	@touch $@

pages: $(BUILD)/pages/stamp

PREFIX ?= /usr/local
install: all pages
	$(Q)packaging/install.sh install '$(BUILD)' '$(PREFIX)' '$(DESTDIR)'

uninstall: pages
	$(Q)packaging/install.sh uninstall '$(BUILD)' '$(PREFIX)' '$(DESTDIR)'

deb: $(BUILD)/deps.deb
	@packaging/deb.sh '$(BUILD)'

clean:
	$(Q)rm -rf $(BUILD)

FORCE:
.PHONY: picture all i386 windows deps pages install uninstall deb check demo show $(SHOWS) bench show-piglit-record show-piglit-parity show-programs test-programs show-tests show-suites \
	golden-update clean FORCE
# Keep objects, including those that only a pattern rule names.
.PRECIOUS: $(BUILD)/%.o
-include $(HELPERS:=.d) $(COMMAND_OBJ:.o=.d) $(OIIO_OBJ:.o=.d) $(RECORDER_OBJ:.o=.d) $(I386_OBJ:.o=.d) $(TESTS:=.d) $(CORPUS:=.d) $(BENCHES:=.d) $(BUILD)/tests/bench/embree_build.d \
	$(BUILD)/tests/fuzz/calls.d $(BUILD)/tests/fuzz/stream.d $(patsubst %.c,$(BUILD)/%.d,$(wildcard tests/same/*.c)) $(BUILD)/gen/fuzz_commands.d $(FUZZ_OBJ:.o=.d) $(DRIVE_OBJ:.o=.d) $(FUZZ_TARGETS:%=$(BUILD)/fuzz/objects/tests/fuzz/fuzz_%.d)
