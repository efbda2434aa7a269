# Relume. Everything made lands in $(BUILD). `make demo` and `make check` are all the set-up there is.
#   V=1                     show commands
#   SAN=address,undefined   sanitizer build, in a folder of its own
#   BUILD=DIR               build elsewhere
SAN ?=
BUILD ?= build$(if $(SAN),/san)
PYTHON := /usr/bin/python3
Q := $(if $(V),,@)
# A machine may carry a python of its own in PATH; the generators need only Debian's.

CFLAGS ?= -O2 -g
CXXFLAGS ?= -O2 -g
WARNINGS := -Wall -Wextra
SANFLAGS := $(if $(SAN),-fsanitize=$(SAN) -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
CPPFLAGS += -I. -I$(BUILD)/gen -isystem /usr/include/OpenEXR -isystem /usr/include/Imath -D_GNU_SOURCE -DCL_TARGET_OPENCL_VERSION=120
ALL_CFLAGS := -std=c11 $(WARNINGS) -ffp-contract=off -fPIC -pthread -MMD -MP $(SANFLAGS) $(CFLAGS)
ALL_CXXFLAGS := -std=c++17 $(WARNINGS) -fPIC -pthread -MMD -MP $(SANFLAGS) $(CXXFLAGS)
LIBS := -lOpenEXRCore-3_1 -lOpenImageIO -lOpenCL -lsnappy -lbrotlidec -lz -lxxhash -lstdc++ -ldl -lm -pthread

# The recorder is linked from few files, so that little of ours runs inside the traced program.
RECORDER_SRC := $(addprefix capture/,wrap.c resolve.c sizes.c writer.c reference.c)
COMMAND_SRC := relume.c $(wildcard base/*.c replay/*.c tracer/*.c diff/*.c kernels/ref/*.c) \
	$(filter-out $(RECORDER_SRC),$(wildcard capture/*.c))
COMMAND_CXX := $(wildcard diff/*.cpp)

COMMAND_GEN := $(BUILD)/gen/kernels.c

COMMAND_OBJ := $(COMMAND_SRC:%.c=$(BUILD)/%.o) $(COMMAND_CXX:%.cpp=$(BUILD)/%.o) $(COMMAND_GEN:.c=.o)

all: $(BUILD)/relume

$(BUILD)/relume: $(COMMAND_OBJ)
	$(Q)$(CC) $(ALL_CFLAGS) -o $@ $^ $(LIBS)

$(BUILD)/%.o: %.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(ALL_CFLAGS) -c -o $@ $<

$(BUILD)/%.o: %.cpp $(BUILD)/flags
	@mkdir -p $(@D)
	$(Q)$(CXX) $(CPPFLAGS) $(ALL_CXXFLAGS) -c -o $@ $<

# Generated headers come before whatever includes them; the .d files know the rest.
GENERATED_H := $(BUILD)/gen/gl_tokens.h
$(COMMAND_OBJ): | $(GENERATED_H)

$(BUILD)/gen/gl_tokens.h: replay/gen.py capture/registry.py
	@mkdir -p $(@D)
	$(Q)$(PYTHON) -B replay/gen.py $@ tokens

$(BUILD)/gen/%.o: $(BUILD)/gen/%.c $(BUILD)/flags
	$(Q)$(CC) $(CPPFLAGS) $(ALL_CFLAGS) -c -o $@ $<

# Kernels travel as text inside the command.
KERNELS := $(wildcard kernels/*.cl)
$(BUILD)/gen/kernels.c: kernels/embed.py $(KERNELS) | $(GENERATED_H)
	@mkdir -p $(@D)
	$(Q)$(PYTHON) kernels/embed.py $@ $(@:.c=.d) . $(BUILD)/gen -- $(KERNELS)
-include $(BUILD)/gen/kernels.d

# Rebuilt when flags change.
$(BUILD)/flags: FORCE
	@mkdir -p $(@D)
	@echo '$(CC) $(CPPFLAGS) $(ALL_CFLAGS) $(CXX) $(ALL_CXXFLAGS)' | cmp -s - $@ || \
		echo '$(CC) $(CPPFLAGS) $(ALL_CFLAGS) $(CXX) $(ALL_CXXFLAGS)' >$@

clean:
	$(Q)rm -rf $(BUILD)

FORCE:
.PHONY: all clean FORCE
-include $(COMMAND_OBJ:.o=.d)
