# `make lint`: GCC's analyzer (lint-gcc) and clang-tidy (lint-tidy, by .clang-tidy) read the command, its bridge and the
# recorder; any finding fails. A file is read again after it, one of its headers or the checks have changed: all take
# three quarters of an hour of one core. Findings depend on the versions of both tools: these are GCC 12 and clang-tidy
# 14 of Debian 12. lint-ci validates the CI files, lint-licence SPDX's licence of each file.
LINT_CC ?= gcc
TIDY ?= clang-tidy
LINT := $(BUILD)/lint
LINT_SRC := $(sort $(COMMAND_SRC) $(VISUAL_SRC))
LINT_FILES := $(patsubst %,$(LINT)/%,$(LINT_SRC:.c=) $(RECORDER_SRC:%.c=recorder/%))
LINT_BY_GCC := $(LINT_FILES:=.o)
LINT_BY_TIDY := $(addsuffix .tidy,$(LINT_FILES) $(patsubst %.cpp,$(LINT)/%,$(wildcard tracer/image/*.cpp)))

# base/err.c defines what lint.h declares.
LINT_H = $(if $(filter base/err.c,$<),,-include tests/lint.h -Wno-unused-value)
# Off: GCC 12 loses arrays that a loop fills or frees, and takes every search for one that may fail; clang-tidy looks
# for leaks and null pointers as well. -O0, as it loses conditions that optimization joins: `if (p && n)` leaves p NULL.
ANALYZER = $(LINT_H) -O0 -fanalyzer -Wno-analyzer-use-of-uninitialized-value -Wno-analyzer-malloc-leak \
	-Wno-analyzer-null-dereference -Werror
# It does not follow a file that a struct keeps.
$(LINT)/replay/index/index_build.o: private ANALYZER += -Wno-analyzer-file-leak
# A function of many branches may take this many steps, a quarter of the default: that takes 5 s, not 17.
LINT_STEPS := -Xclang -analyzer-config -Xclang max-nodes=50000
# $(call tidy,FLAGS): what clang-tidy finds in $<, without its counts of other warnings.
tidy = $(TIDY) --quiet $< -- $(CPPFLAGS) $(LINT_H) $(LINT_STEPS) $(WARNINGS) -Wno-missing-field-initializers $1 \
	2>$@.log || { grep -v ' warnings\? generated' $@.log; exit 1; }

lint: lint-gcc lint-tidy lint-ci lint-licence
lint-gcc: $(LINT_BY_GCC)
lint-tidy: $(LINT_BY_TIDY)

$(LINT)/recorder/%.o: %.c $(BUILD)/recorder/gen/stamp $(BUILD)/flags tests/lint.mk | $(GENERATED_H)
	@mkdir -p $(@D)
	$(Q)$(LINT_CC) $(CPPFLAGS) $(RECORDER_CFLAGS) $(ANALYZER) -c -o $@ $<

$(LINT)/recorder/%.tidy: %.c $(BUILD)/recorder/%.o .clang-tidy tests/lint.h tests/lint.mk
	@mkdir -p $(@D)
	$(Q)$(call tidy,-std=c11 -I$(BUILD)/recorder/gen)
	@touch $@

$(LINT)/%.o: %.c $(BUILD)/flags tests/lint.mk | $(GENERATED_H)
	@mkdir -p $(@D)
	$(Q)$(LINT_CC) $(CPPFLAGS) $(ALL_CFLAGS) $(ANALYZER) -c -o $@ $<

$(LINT)/%.tidy: %.c $(BUILD)/%.o .clang-tidy tests/lint.h tests/lint.mk
	@mkdir -p $(@D)
	$(Q)$(call tidy,-std=c11)
	@touch $@

$(LINT)/%.tidy: %.cpp $(BUILD)/%.o .clang-tidy tests/lint.mk
	@mkdir -p $(@D)
	$(Q)$(subst $(LINT_H),,$(call tidy,-std=c++17))
	@touch $@

# The schemas of GitHub and GitLab are inside check-jsonschema.
lint-ci: $(LINT)/venv/ready
	@PATH="$(abspath $(LINT)/venv/bin):$$PATH" $(PYTHON) -B tests/unit/test_release.py Servers

# Each file has a licence by REUSE.toml: https://reuse.software/spec/
lint-licence: $(LINT)/venv/ready
	@$(LINT)/venv/bin/reuse lint -q

$(LINT)/venv/ready:
	@mkdir -p $(LINT)
	@$(PYTHON) -m venv $(@D) && $(@D)/bin/pip install -q check-jsonschema==0.39.0 reuse==6.2.0
	@touch $@

.PHONY: lint lint-ci lint-gcc lint-licence lint-tidy
-include $(LINT_BY_GCC:.o=.d)
