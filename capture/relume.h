/* SPDX-License-Identifier: MIT */
/*
 * For programs that can be recompiled: hints that OpenGL cannot express. Only this header is needed; no library.
 *
 * Both functions look for a recorder in the process and do nothing if there is none. They may be called whenever a GL
 * context is current, even while a display list is compiled (they are not part of the list).
 */
#ifndef RELUME_H
#define RELUME_H

#include <dlfcn.h> /* link with -ldl before glibc 2.34 */
#include <stddef.h>

#ifndef RTLD_DEFAULT /* glibc shows it only with _GNU_SOURCE */
#define RTLD_DEFAULT ((void *)0)
#endif

#ifdef __cplusplus
extern "C" {
#endif

enum rtMaterialKindEXT {
	RT_MATTE_EXT = 0,  /* as lit by OpenGL; the initial state */
	RT_MIRROR_EXT = 1, /* amount: fraction of the light that is reflected, [0,1] */
	RT_GLASS_EXT = 2   /* amount: fraction of the light that is transmitted, [0,1]; ior: index of refraction, 1.5
	                      for window glass */
};

/** Set the material of everything drawn until the next call, in every context. */
static inline void rtMaterialEXT(enum rtMaterialKindEXT kind, float amount, float ior)
{
	void (*record)(int, float, float);

	*(void **)&record = dlsym(RTLD_DEFAULT, "relume_material");
	if (record)
		record((int)kind, amount, ior);
}

/**
 * The static part of the scene has been drawn once. In later frames of this context, meshes that do not move become
 * kd-trees. It never changes a picture.
 */
static inline void rtBuildKdTreeEXT(void)
{
	void (*record)(void);

	*(void **)&record = dlsym(RTLD_DEFAULT, "relume_build_kd_tree");
	if (record)
		record();
}

#ifdef __cplusplus
}
#endif

#endif
