# The recorder for 32-bit programs, beside the other one where the loader looks for either (capture/record.c).
DEPS_i386 := gcc-multilib g++-multilib libsnappy-dev:i386 libx11-6:i386 libgl1:i386 libgl1-mesa-dri:i386 \
	libglu1-mesa:i386 libglut3.12:i386 mesa-utils-bin:i386
I386_CFLAGS = $(filter-out $(SANFLAGS),$(ALL_CFLAGS)) -m32 -D_FILE_OFFSET_BITS=64 -Wno-psabi -I$(BUILD)/recorder/gen \
	-fvisibility=hidden
I386_OBJ := $(patsubst $(BUILD)/recorder/%,$(BUILD)/i386/%,$(RECORDER_OBJ))
LIBRELUMES := $(BUILD)/lib/i386-linux-gnu/librelume.so $(BUILD)/lib/x86_64-linux-gnu/librelume.so
i386: $(LIBRELUMES) $(addprefix $(BUILD)/i386/,windows two_triangles spheres tricks)

# Both architectures must have the same package version: if the newest is not available for both (an archive's index
# may lag), use that of the release itself. No installed package may be removed for this: apt then reports the
# conflict.
$(BUILD)/deps.i386: packaging/i386.mk | $(HAVE)
	@mkdir -p $(@D)
	@if [ "$$(dpkg-query -W -f '$${db:Status-Status}\n' $(DEPS_i386) 2>/dev/null | \
			grep -cx installed)" != $(words $(DEPS_i386)) ]; then \
		echo "installing from Debian, i386 added: $(DEPS_i386) (see $@.log)"; \
		[ "$$(id -u)" = 0 ] || sudo=sudo; \
		had=$$(dpkg --print-foreign-architectures | grep -cx i386); \
		export DEBIAN_FRONTEND=noninteractive; \
		install="$$sudo apt-get -q -y --no-remove --no-install-recommends install $(DEPS_i386)"; \
		{ $$sudo dpkg --add-architecture i386 && { $$sudo apt-get -q update; \
			$$install || $$install -t $$(. /etc/os-release; echo $$VERSION_CODENAME); }; } \
			>$@.log 2>&1 || { tail -n 20 $@.log; \
			[ $$had = 1 ] || $$sudo dpkg --remove-architecture i386; exit 1; }; \
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

# The same as a package, relume32, of architecture i386.
deb-i386: $(BUILD)/deps.deb-i386 $(BUILD)/deps.i386
	@packaging/deb.sh '$(BUILD)' i386

.PHONY: i386 deb-i386
-include $(I386_OBJ:.o=.d)
