# libFuzzer under sanitizers, a target for each reader: tests/fuzz/fuzz_NAME.c. Findings worth keeping go into
# tests/fuzz/kept*.
FUZZ_SECONDS ?= 3600
FUZZ_CC ?= clang
FUZZ_CXX ?= clang++
FUZZ_TARGETS := $(patsubst tests/fuzz/fuzz_%.c,%,$(wildcard tests/fuzz/fuzz_*.c))
FUZZ_SRC := $(filter-out tracer/image/oiio_load.c $(VISUAL_SRC),$(wildcard $(patsubst %,%/*.c, \
		base capture/format scene scene/repair look/draws look/rules look/spare look/apply verbs/farm verbs/recording \
		$(addprefix diff/,rules baseline score pictures) $(addprefix tracer/,image device) kernels/ref))) \
	$(addprefix tracer/accel/,blas_store.c bvh.c compress.c soup.c tree.c) $(REPLAY_SRC) verbs/render/stamp.c \
	$(addprefix capture/write/,pages.c values.c) $(addprefix tests/fuzz/,calls.c stream.c target.c)
FUZZ_GEN := $(patsubst $(BUILD)/%.c,$(BUILD)/fuzz/objects/%.o, \
		$(filter-out %/page.c %/surfaces.c,$(COMMAND_GEN)) $(BUILD)/gen/fuzz_commands.c) \
	$(BUILD)/fuzz/objects/gen/enums.o
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

# The same targets in one program without libFuzzer, for kept inputs and mutants; each gets another entry name. Linked
# with the same parts of the command as they are, so a file missing from FUZZ_SRC is a link error.
DRIVE_OBJ := $(patsubst %,$(BUILD)/tests/fuzz/targets/%.o,$(filter-out calls replay,$(FUZZ_TARGETS)))
$(BUILD)/tests/fuzz/targets/%.o: tests/fuzz/fuzz_%.c $(BUILD)/flags | $(GENERATED_H)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(ALL_CFLAGS) -DLLVMFuzzerTestOneInput=fuzz_$* -DLLVMFuzzerInitialize=begin_$* \
		-I$(BUILD)/recorder/gen -c -o $@ $<
$(BUILD)/tests/fuzz/targets/recorder.o: | $(BUILD)/recorder/gen/stamp

$(BUILD)/tests/fuzz/drive: $(DRIVE_OBJ) $(BUILD)/tests/fuzz/target.o \
	$(addprefix $(BUILD)/recorder/,capture/write/pages.o capture/write/values.o gen/tables/enums.o)
$(BUILD)/tests/fuzz/drive $(BUILD)/tests/fuzz/make_seeds: $(BUILD)/tests/fuzz/calls.o $(BUILD)/gen/fuzz_commands.o
$(BUILD)/tests/fuzz/drive: $(BUILD)/tests/fuzz/parts.a
$(BUILD)/tests/fuzz/drive: $(BUILD)/tests/fuzz/stream.o
$(BUILD)/tests/fuzz/drive: private NOT_LINKED := $(BUILD)/parts.a
$(BUILD)/tests/fuzz/parts.a: Makefile tests/fuzz.mk $(patsubst $(BUILD)/fuzz/objects/%,$(BUILD)/%, \
	$(filter-out %/gen/enums.o $(addprefix $(BUILD)/fuzz/objects/,capture/write/% tests/%),$(FUZZ_OBJ)))
	@rm -f $@
	$(Q)$(AR) rcs $@ $(filter %.o,$^)

$(BUILD)/gen/fuzz_commands.c: tests/fuzz/gen_commands.py replay/gen.py capture/gen/registry.py $(REPLAY_SRC) \
	| $(GENERATED_H)
	$(Q)$(PYTHON) -B $< $@ $(sort $(REPLAY_SRC))

fuzz: all $(HELPERS) $(CORPUS) $(BUILD)/tests/fuzz/make_seeds $(FUZZ_TARGETS:%=$(BUILD)/fuzz/%)
	@tests/xvfb.sh tests/fuzz/campaign.py $(BUILD) run $(FUZZ_SECONDS) $(ONLY)

# Keeps small inputs: paths that only large ones reach are covered from recordings again.
fuzz-keep: $(FUZZ_TARGETS:%=$(BUILD)/fuzz/%)
	@tests/fuzz/campaign.py $(BUILD) keep $(ONLY)

.PHONY: fuzz fuzz-keep
-include $(BUILD)/tests/fuzz/calls.d $(BUILD)/tests/fuzz/stream.d $(BUILD)/gen/fuzz_commands.d
-include $(FUZZ_OBJ:.o=.d) $(DRIVE_OBJ:.o=.d) $(FUZZ_TARGETS:%=$(BUILD)/fuzz/objects/tests/fuzz/fuzz_%.d)
