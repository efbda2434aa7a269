# Prerequisites of `make check`.

# Programs to record: plain OpenGL programs, built as anybody would build them.
CORPUS := $(patsubst %.c,$(BUILD)/%,$(wildcard corpus/*.c corpus/es/*.c corpus/glx/*.c corpus/wayland/*.c)) \
	$(BUILD)/corpus/rooms
TESTS := $(patsubst %.c,$(BUILD)/%,$(wildcard tests/*/test_*.c tests/harness/fails.c)) \
	$(addprefix $(BUILD)/tests/,bench/tiny bench/translate fuzz/drive fuzz/make_seeds)
$(TESTS:=.o): | $(GENERATED_H)

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
	$(Q)$(CC) -std=c11 $(WARNINGS) -O2 -MMD -MP -MF $@.d -MT $@ -o $@ $< \
		-lwayland-client -lwayland-egl -lEGL -lGL -lm

$(BUILD)/corpus/rooms: $(wildcard corpus/rooms/*.[ch]) corpus/program.h $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O2 -o $@ $(filter %.c,$^) -lglut -lGLU -lGL -lm

# Only the recorder with a sanitizer, for the threads test: it then needs a program linked with the sanitizer's runtime.
SANITIZED_CFLAGS = -std=c11 $(WARNINGS) -O1 -g -fPIC -pthread -fvisibility=hidden -fno-omit-frame-pointer \
	-I$(BUILD)/recorder/gen
$(BUILD)/sanitized/%/librelume.so: $(RECORDER_OBJ) capture/gen/exports.map $(BUILD)/relume
	@mkdir -p $(@D)
	$(Q)cp $(BUILD)/relume $(@D)/relume
	$(Q)$(CC) $(CPPFLAGS) $(SANITIZED_CFLAGS) -fsanitize=$* -shared -Wl,-Bsymbolic \
		-Wl,--version-script=capture/gen/exports.map -o $@ $(RECORDER_SRC) \
		capture/format/sizes.c capture/format/ref_pack.c $(RECORDER_GEN:%=$(BUILD)/recorder/gen/%.c) \
		-l:libsnappy.a -lstdc++ -ldl -pthread

$(BUILD)/sanitized/%/threads: tests/trace/threads.c tests/trace/window.h
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O1 -g -fsanitize=$* -D_GNU_SOURCE -DGL_GLEXT_PROTOTYPES -I. -o $@ $< \
		-lGL -lX11 -ldl -lm -pthread

# Tests are linked with all of the command but its main function, and with the bridge directly.
$(BUILD)/parts.a: $(filter-out $(BUILD)/relume.o $(BUILD)/tracer/image/oiio_load.o,$(COMMAND_OBJ)) \
	$(BUILD)/tracer/image/oiio.o
	@rm -f $@
	$(Q)$(AR) rcs $@ $^

$(BUILD)/tests/fuzz/test_stream: $(BUILD)/tests/fuzz/stream.o
$(BUILD)/tests/fuzz/test_calls $(BUILD)/tests/fuzz/test_pictures $(BUILD)/tests/fuzz/test_stream: \
	$(BUILD)/tests/fuzz/calls.o $(BUILD)/gen/fuzz_commands.o
$(BUILD)/tests/%: $(BUILD)/tests/%.o $(BUILD)/parts.a
	$(Q)$(CXX) $(ALL_CXXFLAGS) -o $@ $(filter %.o,$^) $(filter-out $(NOT_LINKED),$(filter %.a,$^)) \
		$(LIBS_OIIO) $(LIBS) $(LIBS_$(@F)) -lcheck -lsubunit -lm

LIBS_test_blend := -lEGL -lGL

# Rewrites recordings so that they draw the same picture by other calls.
$(BUILD)/tests/same/relations: $(patsubst %.c,$(BUILD)/%.o, \
	$(filter-out tests/same/relations.c,$(wildcard tests/same/*.c)))

# Libraries and programs that tests preload or record: not linked with any part of Relume.
HELPERS := $(patsubst %.c,$(BUILD)/%.so,$(wildcard tests/real/*_shim.c) tests/real/failing_cl.c tests/check/host_cl.c) \
	$(BUILD)/tests/bench/static_scene $(addprefix $(BUILD)/tests/real/, \
		back blocking closer composed cracks deep depths elsewhere empty endless errors front greedy growing \
		kdtree layers leaving linear moments moved multisampled objects parameters parting parts persistent \
		pixels pixmaps projections readbacks recut samples shapes shared sheets shoal sizes stair sums \
		surfaces targets textures turning units vertices windows) \
	$(patsubst %.c,$(BUILD)/%,$(wildcard tests/real/panels/*.c tests/real/small/*.c)) \
	$(patsubst %.c,$(BUILD)/%,$(filter-out $(wildcard tests/trace/test_*.c),$(wildcard tests/trace/*.c)))

$(BUILD)/tests/%.so: tests/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O2 -D_GNU_SOURCE -shared -fPIC -o $@ $< -ldl

$(filter-out %.so,$(HELPERS)): $(BUILD)/%: %.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O2 -D_GNU_SOURCE -DGL_GLEXT_PROTOTYPES -I. -MMD -MP -MF $@.d -MT $@ -o $@ $< \
		-lGL -lX11 -ldl -lm -pthread

# Randomly generated legacy programs.
$(BUILD)/tests/generated/program: $(wildcard tests/generated/*.[ch]) $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(WARNINGS) -O2 -D_GNU_SOURCE -DGL_GLEXT_PROTOTYPES -I. -o $@ $(filter %.c,$^) -lGL -lX11 -lm

# Programs that check/test_host runs.
HOST_TESTS := $(addprefix $(BUILD)/tests/check/test_,rays camera shade compose)

# With ONLY, prerequisites of other tests are not built.
HARNESS := $(BUILD)/tests/harness/fails $(BUILD)/tests/bench/tiny $(BUILD)/tests/fuzz/drive $(HOST_TESTS)
BUILT_FOR_TESTS := $(HELPERS) $(BUILD)/tests/same/relations $(BUILD)/tests/generated/program \
	$(addprefix $(BUILD)/tests/bench/,hits build queries)
TESTS_ASKED := $(if $(ONLY),$(HARNESS) $(foreach part,$(ONLY),\
	$(foreach t,$(TESTS),$(if $(findstring $(part),$(t:$(BUILD)/tests/%=%)),$t))),$(TESTS))

# Only in a separate commit.
golden-update: all
	@$(PYTHON) tests/golden/test_golden.py --update

.PHONY: golden-update
-include $(HELPERS:=.d) $(TESTS:=.d) $(CORPUS:=.d) $(patsubst %.c,$(BUILD)/%.d,$(wildcard tests/same/*.c))
