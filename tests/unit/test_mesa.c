/* Versions of Mesa (scene/mesa.h) parsed from their names. Their effect on lines and points: test_expand. */
#include "scene/mesa.h"
#include "tests/case.h"

START_TEST(test_versions)
{
	static const struct { const char *gl; uint32_t has, lacks;
	} versions[] = {
		{ "4.5 (Compatibility Profile) Mesa 22.3.6, llvmpipe (LLVM 15.0.6, 256 bits)", 0, ~0u },
		{ "4.5 (Compatibility Profile) Mesa 23.1.9, llvmpipe (LLVM 15.0.6, 256 bits)", 0, ~0u },
		{ "4.5 (Compatibility Profile) Mesa 23.2.1, llvmpipe (LLVM 15.0.6, 256 bits)", SCENE_MESA_LINE_ENDS,
		  ~(uint32_t)SCENE_MESA_LINE_ENDS },
		{ "OpenGL ES-CM 1.1 Mesa 25.0.7-2+deb13u1, llvmpipe (LLVM 19.1.7, 256 bits)",
		  SCENE_MESA_LINE_ENDS | SCENE_MESA_BITMAP_SUMS, 0 },
		{ "4.5 (Compatibility Profile) Mesa 26.1.6-1, llvmpipe (LLVM 21.1.8, 256 bits)",
		  SCENE_MESA_LINE_ENDS | SCENE_MESA_SPRITES, SCENE_MESA_BITMAP_SUMS },
		{ "4.5 (Compatibility Profile) Mesa 25.0.7, softpipe", 0, ~0u },
		{ "4.6.0 NVIDIA 550.54.14, NVIDIA H200/PCIe/SSE2", SCENE_MESA_IS_OTHER,
		  ~(uint32_t)SCENE_MESA_IS_OTHER },
		{ "Mesa llvmpipe", 0, ~0u },
		{ "", 0, ~0u },
	};

	for (size_t i = 0; i < sizeof(versions) / sizeof(versions[0]); i++) {
		const uint32_t mesa = scene_mesa_of(versions[i].gl);

		ck_assert_msg((mesa & versions[i].has) == versions[i].has && !(mesa & versions[i].lacks), "%s: %x",
		              versions[i].gl, mesa);
	}
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("mesa");

	tcase_add_test(tcase, test_versions);
	return run_case(tcase, "mesa");
}
