# Relume. All output goes to $(BUILD). `make demo` and `make check` need no other set-up.
#   make                    build; lists missing packages, installs nothing
#   make demo               install what this needs; record, ray trace and score a real program
#   make check              install what tests need, run all of them on all cores; ONLY="part of a name" runs some
#   make lint               clang-tidy and GCC's analyzer, without findings; CI files by their schemas; SPDX
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
# Tests and analyzers use all cores unless -j is given.
ifneq ($(filter check lint,$(MAKECMDGOALS)),)
MAKEFLAGS += -j$(shell nproc)
endif
# HAVE exists once all packages that a build needs are installed. INSTALLING: groups (packaging/deps.txt) that the
# goals install.
HAVE := $(BUILD)/have
INSTALLING := $(if $(filter-out show-suites,$(filter bench check deps fuzz fuzz-keep golden-update show show-% \
	test-programs,$(MAKECMDGOALS))),check) $(filter deb deb-i386 gallery lint picture,$(MAKECMDGOALS))
PYTHON := /usr/bin/python3
Q := $(if $(V),,@)
# PATH may have another python; the generators need only Debian's.

CFLAGS ?= -O2 -g
CXXFLAGS ?= -O2 -g
# To GCC { NULL } is a complete initializer; clang warns about missing fields.
WARNINGS := -Wall -Wextra \
	$(if $(findstring clang,$(shell { $(CC) --version; } 2>/dev/null)),-Wno-missing-field-initializers)
SANFLAGS := $(if $(SAN),-fsanitize=$(SAN) -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
CPPFLAGS += -I. -I$(BUILD)/gen -isystem /usr/include/OpenEXR -isystem /usr/include/Imath -D_GNU_SOURCE \
	-DCL_TARGET_OPENCL_VERSION=120
ALL_CFLAGS := -std=c11 $(WARNINGS) -Werror=override-init -Werror=incompatible-pointer-types -ffp-contract=off -fPIC \
	-pthread -MMD -MP $(SANFLAGS) $(CFLAGS)
ALL_CXXFLAGS := -std=c++17 $(WARNINGS) -fPIC -pthread -MMD -MP $(SANFLAGS) $(CXXFLAGS)
LIBS_OIIO := -Wl,--as-needed -lOpenImageIO -lOpenImageIO_Util -lstdc++
LIBS := -Wl,--as-needed -lOpenEXRCore -lOpenCL -lsnappy -lpng -lbrotlidec -lz -ldeflate -lisal -lxxhash -lcyaml \
	-lseccomp -ldl -lm -pthread

# The recorder is linked from few files, so that little of Relume runs inside the traced program. The sizes are shared.
RECORDER_SRC := $(wildcard capture/gen/*.c capture/client/*.c capture/gl/*.c capture/write/*.c)
RECORDER_GEN := tables/commands tables/enums thunks
RECORDER_OBJ := $(RECORDER_SRC:%.c=$(BUILD)/recorder/%.o) \
	$(patsubst %,$(BUILD)/recorder/capture/format/%.o,sizes reserve ref_pack sidecar) \
	$(patsubst %,$(BUILD)/recorder/gen/%.o,$(RECORDER_GEN))
VISUAL_SRC := verbs/recording/visual.c
REPLAY_SRC := $(wildcard replay/*.c replay/*/*.c replay/*/*/*.c)
COMMAND_SRC := relume.c $(REPLAY_SRC) $(wildcard $(patsubst %,%/*.c, \
	base capture capture/format ci scene scene/repair look/* look/*/* kernels/ref tracer/* tracer/frame/*) diff/*.c \
	diff/*/*.c) $(filter-out $(VISUAL_SRC),$(wildcard verbs/*/*.c verbs/*/*/*.c))
COMMAND_GEN := $(patsubst %,$(BUILD)/gen/%.c,kernels commands handlers page manual surfaces)
COMMAND_OBJ := $(COMMAND_SRC:%.c=$(BUILD)/%.o) $(COMMAND_GEN:.c=.o)

# The bridge to OpenImageIO, loaded when a picture needs it, and the parts of the command that it calls.
OIIO_OBJ := $(patsubst %,$(BUILD)/tracer/image/%.o,oiio heads image pack exr_pack) \
	$(BUILD)/base/err.o $(BUILD)/base/memory.o

all: $(BUILD)/relume $(BUILD)/librelume.so $(BUILD)/librelume-rays.so $(BUILD)/relume-oiio.so $(BUILD)/visual/libGL.so.1

# Snappy and its C++ inside, as in the recorder: looking up C++ symbols takes the loader a third of the start-up time.
$(BUILD)/relume: $(COMMAND_OBJ)
	$(Q)$(CXX) $(ALL_CXXFLAGS) $(LDFLAGS) $(if $(SAN),,-static-libstdc++ -static-libgcc) -o $@ $^ \
		$(LIBS:-lsnappy=-l:libsnappy.a)

# The same code without its main function, for other programs: verbs/query/relume-rays.h.
RAYS_OBJ := $(filter-out $(BUILD)/relume.o,$(COMMAND_OBJ))
$(BUILD)/librelume-rays.so: $(RAYS_OBJ) verbs/query/exports.map
	$(Q)$(CXX) $(ALL_CXXFLAGS) $(LDFLAGS) -shared -static-libstdc++ -static-libgcc -Wl,-Bsymbolic \
		-Wl,-soname,librelume-rays.so -Wl,--version-script=verbs/query/exports.map -o $@ $(RAYS_OBJ) \
	$(LIBS:-lsnappy=-l:libsnappy.a)

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
	$(Q)$(CC) $(CPPFLAGS) $(filter-out $(SANFLAGS),$(ALL_CFLAGS)) $(LDFLAGS) -shared -fPIC \
		-Wl,-soname,libGL.so.1 -o $@ $< -Wl,--no-as-needed -l:libGLX.so.0 -l:libOpenGL.so.0 -ldl

# The recorder runs in other programs: no sanitizer, no exported symbols but the commands of GL, Snappy and its
# C++ linked in, no symbol of its own that the program could replace.
RECORDER_CFLAGS = $(filter-out $(SANFLAGS),$(ALL_CFLAGS)) -I$(BUILD)/recorder/gen -fvisibility=hidden
$(BUILD)/librelume.so: $(RECORDER_OBJ) capture/gen/exports.map
	$(Q)$(CXX) -shared $(LDFLAGS) -static-libstdc++ -static-libgcc -Wl,-Bsymbolic -Wl,-z,defs \
		-Wl,--version-script=capture/gen/exports.map -o $@ $(RECORDER_OBJ) -l:libsnappy.a -ldl -pthread

$(BUILD)/recorder/gen/stamp $(RECORDER_GEN:%=$(BUILD)/recorder/gen/%.c) &: capture/gen/gen.py \
	capture/gen/registry.py capture/gen/overlay.txt | $(HAVE)
	@mkdir -p $(BUILD)/recorder/gen
	$(Q)$(PYTHON) -B capture/gen/gen.py capture/gen/overlay.txt $(BUILD)/recorder/gen
	@touch $(BUILD)/recorder/gen/stamp $(RECORDER_GEN:%=$(BUILD)/recorder/gen/%.c)

$(BUILD)/recorder/gen/%.o: $(BUILD)/recorder/gen/%.c $(BUILD)/flags
	$(Q)$(CC) $(CPPFLAGS) $(RECORDER_CFLAGS) -O2 -g0 -c -o $@ $<

$(BUILD)/recorder/%.o: %.c $(BUILD)/recorder/gen/stamp $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(RECORDER_CFLAGS) -c -o $@ $<

# Generated headers are built before files that include them; the .d files have the other dependencies.
GENERATED_H := $(BUILD)/gen/gl_tokens.h $(BUILD)/gen/layout.h $(BUILD)/gen/packs.h $(BUILD)/gen/version_number.h
$(COMMAND_OBJ): | $(GENERATED_H)
$(GENERATED_H): | $(HAVE)

$(BUILD)/gen/gl_tokens.h: replay/gen.py capture/gen/registry.py
	@mkdir -p $(@D)
	$(Q)$(PYTHON) -B replay/gen.py $@ tokens

# What packs of the kernels refuse, from a list of all members of materials, units and lights.
$(BUILD)/gen/packs.h: kernels/packs.py kernels/packs.txt base/structs.py scene/scene.h
	@mkdir -p $(@D)
	$(Q)$(PYTHON) -B kernels/packs.py kernels/packs.txt scene/scene.h $@

$(BUILD)/gen/version_number.h: VERSION
	@mkdir -p $(@D)
	$(Q)printf '/* Made by the Makefile from VERSION. */\n#define RELUME_VERSION "%s"\n' "$$(cat $<)" >$@

# Members of the state machine that snapshots save: snapshots of another layout are not read (replay/index/layout.txt).
LAYOUT := replay/index/layout
$(BUILD)/gen/layout.h: $(LAYOUT).py $(LAYOUT).txt $(BUILD)/gen/gl_tokens.h
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) -std=c11 -E -P -MD -MP -MF $(@:.h=.dep) -MT $@ -include replay/index/snapshot_parts.h \
		-x c - </dev/null | $(PYTHON) -B $(LAYOUT).py $(LAYOUT).txt $@
-include $(BUILD)/gen/layout.dep

# Rewritten if a handler's line changes; left alone, and so not recompiled, if other lines do.
$(BUILD)/gen/commands.c $(BUILD)/gen/handlers.c: $(BUILD)/gen/%.c: replay/gen.py replay/overlay.txt \
	capture/gen/overlay.txt capture/gen/registry.py $(REPLAY_SRC) | $(GENERATED_H)
	$(Q)$(PYTHON) -B replay/gen.py $@ $* replay/overlay.txt capture/gen/overlay.txt $(sort $(REPLAY_SRC))

$(BUILD)/gen/%.o: $(BUILD)/gen/%.c $(BUILD)/flags
	$(Q)$(CC) $(CPPFLAGS) $(ALL_CFLAGS) -c -o $@ $<

# Kernels are embedded in the command as text.
KERNELS := $(wildcard kernels/*/*.cl kernels/*/*/*.cl)
HOST_TEXTS := kernels/ref/host_builtins.h kernels/ref/hook_host.h # hooks of the reference device: tracer/hook/host.h
$(BUILD)/gen/kernels.c: kernels/embed.py $(KERNELS) $(HOST_TEXTS) | $(GENERATED_H)
	@mkdir -p $(@D)
	$(Q)$(PYTHON) kernels/embed.py $@ $(@:.c=.dep) . $(BUILD)/gen -- $(KERNELS) $(HOST_TEXTS)
-include $(BUILD)/gen/kernels.dep

# The report's page, as a C string.
$(BUILD)/gen/page.c: diff/report/page.html diff/report/page.js
	@mkdir -p $(@D)
	$(Q)(echo '#include "diff/report/report.h"'; echo 'const char report_page[] ='; \
		sed -e '/^\/\*SCRIPT\*\/$$/{r diff/report/page.js' -e 'd}' $< | \
		sed 's/[\\"]/\\&/g; s/.*/"&\\n"/'; echo ';') >$@

# Texts of `relume help` about file formats, and examples.
$(BUILD)/gen/manual.c: packaging/manual.py | $(GENERATED_H)
	@mkdir -p $(@D)
	$(Q)$(PYTHON) -B $< $@ $(@:.c=.dep)
-include $(BUILD)/gen/manual.dep

# The page of relume look --sheet, as a C string.
$(BUILD)/gen/surfaces.c: verbs/render/surfaces.html
	@mkdir -p $(@D)
	$(Q)(echo '#include "verbs/render/surfaces.h"'; echo 'const char surfaces_page[] ='; \
		sed 's/[\\"]/\\&/g; s/.*/"&\\n"/' $<; echo ';') >$@

# Rebuilt when flags change.
FLAGS := $(CC) $(CPPFLAGS) $(ALL_CFLAGS) $(CXX) $(ALL_CXXFLAGS)
ifneq ($(file <$(BUILD)/flags),$(FLAGS))
$(BUILD)/flags: FORCE
endif
$(BUILD)/flags: | $(HAVE)
	@mkdir -p $(@D)
	@echo '$(FLAGS)' >$@

# Nothing is compiled before the packages it needs are installed. `make` only lists missing ones; INSTALLING goals
# install them first.
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

# Prerequisites of make check, programs for other systems, figures, fuzzing, and the recorder for 32-bit programs.
include tests/check.mk tests/lint.mk tests/foreign.mk tests/show.mk tests/fuzz.mk packaging/i386.mk

check: all pages $(CORPUS) $(TESTS_ASKED) $(BUILT_FOR_TESTS)
	$(Q)$(PYTHON) tests/run.py $(BUILD) $(ONLY)

demo:
	@corpus/demo.sh $(BUILD)

# The picture at the top of README.md.
picture: all $(BUILD)/corpus/glx/marbles
	@corpus/picture.sh $(BUILD)

# The pictures of docs/look.md.
gallery: all $(addprefix $(BUILD)/corpus/,cornell facets phong spheres street)
	@corpus/gallery.sh $(BUILD)

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
.PHONY: all deps pages install uninstall deb check demo picture gallery clean FORCE
# Keep objects, including those that only a pattern rule names.
.PRECIOUS: $(BUILD)/%.o
-include $(COMMAND_OBJ:.o=.d) $(OIIO_OBJ:.o=.d) $(RECORDER_OBJ:.o=.d)
