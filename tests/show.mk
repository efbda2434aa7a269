# Figures with their bars: each show-NAME writes $(BUILD)/show/NAME.json, and fails if a figure misses its bar. Group
# NAME of packaging/deps.txt lists packages that only it needs, NEEDS_NAME its build prerequisites; those ON_SCREEN
# need a display.
SHOWS := show-house show-rays show-rays-avx2 show-hits show-query show-build show-host show-metrics \
	show-batch-faults show-device-faults
SCRIPTS := beyond bisect ci crashes cryptomatte devices export farm faults flaky frames fuzz generated hooks inject \
	journeys kill look mutants oclgrind overhead page parity path photons reach reduce relit replay rooms same \
	sandbox sanitize seek film lot soak sweep sweep-record thesis words
SCRIPT_bisect := bisection# Python has a module bisect
SCRIPT_words := prose# which imports tests/words.py
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
	@$(if $(filter $*,$(ON_SCREEN)),tests/xvfb.sh) $(PYTHON) -B tests/show/$(or $(SCRIPT_$*),$(subst -,_,$*)).py \
		$(BUILD) $(ONLY:%=--only %)

# Measures of the source: cycles, sizes, repetitions.
show-house: all
	@$(PYTHON) -B tests/house.py $(BUILD) --count --json $(BUILD)/show/house.json

# Benchmarks against Embree, which is linked only here: the traversal kernels (bench: without a bar), whole frames
# against the rays in them and a rasteriser, hits ray by ray and queries one by one (the tests of those names in
# tests/check run fewer), the builders of acceleration structures.
MODELS ?= ../shared/models
BENCHES := $(addprefix $(BUILD)/tests/bench/,embree frame_rays hits build queries)
$(BENCHES:=.o): | $(GENERATED_H)
$(addprefix $(BUILD)/tests/bench/,embree.o frame_rays.o): private ALL_CFLAGS += -O3 -march=native
$(BUILD)/tests/bench/build: $(BUILD)/tests/bench/embree_build.o
$(BUILD)/tests/bench/queries: $(BUILD)/tests/bench/brute.o
$(BENCHES): %: %.o $(BUILD)/parts.a
	$(Q)$(CXX) $(ALL_CXXFLAGS) -o $@ $(filter %.o,$^) $(BUILD)/parts.a \
		-l$$(test -e /usr/include/embree4 && echo embree4 || echo embree3) $(LIBS_OIIO) $(LIBS)

bench: $(BUILD)/tests/bench/embree
	@$< --models $(MODELS) --json $(BUILD)/bench.json --command "make bench"

show-rays show-rays-avx2: $(BUILD)/tests/bench/embree
show-hits: $(BUILD)/tests/bench/hits
show-query: $(BUILD)/tests/bench/queries
show-build: $(BUILD)/tests/bench/build
# As on a processor without AVX-512: PoCL compiles for such a processor, and Embree is limited to AVX2.
show-rays-avx2: $(BUILD)/tests/real/avx2_shim.so
show-rays-avx2: NARROW = LD_PRELOAD=$(abspath $(BUILD)/tests/real/avx2_shim.so) \
	POCL_CACHE_DIR=$(abspath $(BUILD)/tests/pocl-cache-avx2)
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

# Clang compiles kernels for GPUs; ptxas, a package of PyPI, assembles them for NVIDIA's.
SHOWS += show-gpu-code
$(BUILD)/show/gpu-code/venv/ready: | $(BUILD)/deps.gpu-code
	@$(PYTHON) -m venv $(@D) && $(@D)/bin/pip install -q nvidia-cuda-nvcc-cu12==12.9.86
	@touch $@

show-gpu-code: all $(BUILD)/show/gpu-code/venv/ready
	@$(PYTHON) -B tests/show/gpu_code.py $(BUILD)

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

# Piglit's tests of ARB programs and GLSL, Relume's own panels, and the cost of programs; ONLY=real: third-party
# programs.
show-programs: all $(HELPERS) $(CORPUS) $(BUILD)/tests/bench/translate $(BUILD)/deps.piglit \
	$(if $(filter real,$(ONLY)),$(BUILD)/deps.programs)
	@tests/xvfb.sh $(PYTHON) -B tests/show/stages.py $(BUILD) $(ONLY)

# Not part of `make show`: puts faults into the sources, each behind a switch, and runs the tests; takes hours.
# Resumes where it was stopped.
TESTS_SECONDS ?=
test-programs: all $(TESTS) $(BUILT_FOR_TESTS)
show-tests: all
	@$(PYTHON) -B tests/show/tests.py $(BUILD) $(ONLY:%=--only %) $(TESTS_SECONDS:%=--seconds %)

# Not part of `make show`: the README's commands in bare chroots of Debian's releases, and arm64 under qemu-user.
# Needs root, and most of an hour for each; SUITE=NAME runs one.
SUITE ?=
show-suites: $(BUILD)/deps.suites $(if $(filter-out arm64,$(SUITE)),,all)
	@$(PYTHON) -B tests/show/suites.py $(BUILD) $(SUITE:%=--only %)

# Debian programs, in addition to those of the group.
$(addprefix $(BUILD)/deps.,lot sweep sweep-record): $(BUILD)/deps.%: packaging/deps.txt \
	tests/show/more_programs.py | $(BUILD)/deps.check
	@packaging/deps.sh install $* -- $$($(PYTHON) -B tests/show/more_programs.py) 2>$@.log || \
		{ tail -n 20 $@.log; exit 1; }
	@touch $@

.PHONY: show $(SHOWS) bench show-piglit-record show-piglit-parity show-programs test-programs show-tests show-suites
-include $(BENCHES:=.d) $(BUILD)/tests/bench/embree_build.d
