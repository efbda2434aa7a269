# Test programs for other systems: 32-bit ones, and Windows.

# Programs for the test of the 32-bit recorder (packaging/i386.mk) and for show-reach.
$(BUILD)/i386/windows: tests/real/windows.c tests/trace/window.h | $(BUILD)/deps.i386
	@mkdir -p $(@D)
	$(Q)$(CC) -m32 -std=c11 $(WARNINGS) -O2 -D_GNU_SOURCE -DGL_GLEXT_PROTOTYPES -I. -o $@ $< \
		-l:libGL.so.1 -l:libX11.so.6 -lm -pthread

$(BUILD)/i386/%: corpus/%.c corpus/program.h | $(BUILD)/deps.i386
	@mkdir -p $(@D)
	$(Q)$(CC) -m32 -std=c11 $(WARNINGS) -O2 -D_GNU_SOURCE -o $@ $< \
		-l:libglut.so.3.12 -l:libGLU.so.1 -l:libGL.so.1 -lm

# Windows programs, for Wine: unchanged corpus programs, also as 32-bit ones, and one with Windows' own kinds of
# windows.
WINDOWS := $(addprefix $(BUILD)/windows/,two_triangles.exe spheres.exe tricks.exe wgl.exe)
WINE32 := $(BUILD)/wine32/usr/lib/i386-linux-gnu/libfreetype.so.6
WINDOWS32 := $(foreach p,two_triangles spheres tricks,$(BUILD)/windows32/$p.exe $(BUILD)/i386/sse/$p) \
	$(BUILD)/windows32/wgl.exe $(WINE32)
MINGW = -w64-mingw32-gcc -std=gnu11 $(WARNINGS) -O2 -ffp-contract=off
windows: $(WINDOWS) $(WINDOWS32)

$(BUILD)/windows/wgl.exe: tests/real/wgl.c | $(BUILD)/deps.windows
	@mkdir -p $(@D)
	$(Q)x86_64$(MINGW) -o $@ $< -lopengl32 -lgdi32

$(BUILD)/windows32/wgl.exe: tests/real/wgl.c | $(BUILD)/deps.windows
	@mkdir -p $(@D)
	$(Q)i686$(MINGW) $(SSE) -o $@ $< -lopengl32 -lgdi32

$(BUILD)/windows/%.exe: corpus/%.c corpus/program.h corpus/windows/GL/glut.h | $(BUILD)/deps.windows
	@mkdir -p $(@D)
	$(Q)x86_64$(MINGW) -Icorpus/windows -o $@ $< -lglu32 -lopengl32 -lgdi32

# 32-bit Windows programs have twins on Linux, as Mesa's 32-bit pixels differ from its 64-bit ones. Both use SSE: the
# x87 rounds to different widths on the two systems.
SSE := -msse2 -mfpmath=sse
$(BUILD)/i386/sse/%: corpus/%.c corpus/program.h | $(BUILD)/deps.i386
	@mkdir -p $(@D)
	$(Q)$(CC) -m32 $(SSE) -std=c11 $(WARNINGS) -O2 -D_GNU_SOURCE -o $@ $< \
		-l:libglut.so.3.12 -l:libGLU.so.1 -l:libGL.so.1 -lm

$(BUILD)/windows32/%.exe: corpus/%.c corpus/program.h corpus/windows/GL/glut.h | $(BUILD)/deps.windows
	@mkdir -p $(@D)
	$(Q)i686$(MINGW) $(SSE) -Icorpus/windows -o $@ $< -lglu32 -lopengl32 -lgdi32

# Wine for both classes, in a folder. Debian's wine32 is unpacked, not installed: installing it needs half of i386, in
# the package versions of this system, which an archive may lack. It has the same version as the wine64 that starts
# it. FreeType, for text, is unpacked beside it.
WINE32_FONTS := libfreetype6:i386 libpng16-16:i386 libbrotli1:i386
$(WINE32): | $(BUILD)/deps.windows $(BUILD)/deps.i386
	$(Q)rm -rf $(BUILD)/wine32 $(BUILD)/wine32.new && mkdir -p $(BUILD)/wine32.new
	$(Q)version=$$(dpkg-query -W -f '$${Version}' wine64) && cd $(BUILD)/wine32.new && \
		{ apt-get -q download wine32:i386=$$version libwine:i386=$$version $(WINE32_FONTS) >download.log 2>&1 || \
			{ cat download.log; exit 1; }; } && \
		for package in *.deb; do dpkg -x $$package . && rm $$package || exit 1; done
	$(Q)cp /usr/lib/wine/wine64 $(BUILD)/wine32.new/usr/lib/wine
	$(Q)cp /usr/lib/x86_64-linux-gnu/wine/i386-windows/zlib1.dll \
		$(BUILD)/wine32.new/usr/lib/i386-linux-gnu/wine/i386-windows
	$(Q)mkdir $(BUILD)/wine32.new/usr/lib/x86_64-linux-gnu && \
		ln -s /usr/lib/x86_64-linux-gnu/wine $(BUILD)/wine32.new/usr/lib/x86_64-linux-gnu/wine
	$(Q)mv $(BUILD)/wine32.new $(BUILD)/wine32

.PHONY: windows
