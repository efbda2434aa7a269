/* Choices for a frame, and what the tracer counts. */
#pragma once

#include "scene/scene.h"
#include "tracer/accel/accel.h"
#include "tracer/hook/hook.h"
#include "tracer/image/image.h"

enum tracer_mode {
	TRACER_WHITTED,  /* GL's picture, shadows, mirrors, glass */
	TRACER_GL,       /* GL's picture only: beauty equals gl */
	TRACER_NORMALS,  /* eye-space normals as colours */
	TRACER_AO,       /* how open each surface is, as grey */
	TRACER_AO_PHONG, /* the same over GL's picture */
	TRACER_DIFFUSE,  /* whitted with one bounce of light from surface to surface */
	TRACER_PATH      /* light followed from surface to surface, no ambient light; linear unless `display` is set */
};

struct tracer_options {
	enum tracer_mode mode;
	int display;      /* 1: channels keep GL's display-referred numbers; 0: linear light */
	unsigned depth;   /* most bounces */
	unsigned samples; /* samples per pixel, which is their mean; each pixel has its own pattern
	                   * (kernels/frame/light/sample.h); 0 counts as 1 */
	double seconds;   /* if above 0, no sample begins that would end later; the picture then depends on timing */
	float noise;      /* if above 0, no sample begins once the noise of the picture is below this (noise.h) */
	/* If not NULL, called now and then with a complete picture of the samples so far. @return 0, or ERR_*
	 * (reported), which ends the frame */
	int (*preview)(void *user, struct image *img);
	void *preview_user;
	/* If not NULL, called after each sample with the number done. of: total number; 0 if time or noise decides */
	void (*sampled)(void *user, uint32_t done, uint32_t of);
	void *sampled_user;
	/* Returns the scene of a sample; NULL: all samples show the same scene. away: fraction of the time that the
	 * shutter is open, relative to its middle, in [-0.5,0.5). The scene has the frame's size and is valid until the
	 * next call. @return 0 or ERR_* (reported) */
	int (*expose)(void *user, double away, const struct scene **scene);
	void *expose_user;
	unsigned rays;    /* rays per sample to each light with a size, and into the surroundings; 0 counts as 16 */
	float clamp;      /* mode path: most light that a path may contribute, unless it took only one mirror or glass;
	                   * 0: no limit */
	float reach;      /* reach of openness in eye-space units; 0: unlimited */
	enum accel_kind accel; /* builder of mesh trees */
	int accel_asked;       /* 0: accel is a default, replaced by kd-trees if the program called rtBuildKdTreeEXT */
	struct blas_store *store; /* keeps trees for other runs, or NULL; used until the last tracer_render returns */
	unsigned band_rows; /* rows of pixels drawn at a time; 0: chosen for the device. Does not affect the picture */
	int relight;      /* 1: light each pixel (Phong) instead of interpolating vertex colours */
	const struct hook *hook; /* a user's hook, or NULL; already passed to device_take_hook */
	unsigned photons; /* photons for channels caustics.*, whatever aov lists (photons.h); 0: no such channels */
	int counts;       /* 1: count what tracing adds (tracer_added) */
	const char *aov;  /* channel groups to store, separated by commas ("gl,shadow,N"); NULL: all. R G B A are always
	                   * stored */
};

/* Effects that tracing adds to OpenGL's picture, by the channels that hold them. */
enum tracer_part { TRACER_SHADOWS, TRACER_RELIGHT, TRACER_MIRRORS, TRACER_GLASS, N_TRACER_PARTS };

/* Pixels so far that show these effects, in frames rendered with tracer_options.counts in modes whitted, diffuse and
 * path. */
struct tracer_added {
	uint64_t pixels;                /* all pixels counted */
	uint64_t parts[N_TRACER_PARTS]; /* pixels that show each part */
	uint64_t changed;               /* pixels that show any part */
};

/* Counts of what the tracer could not draw so far; all 0 if everything was drawn. */
struct tracer_undrawn {
	uint64_t targets; /* instances that drew to a target other than the window */
	uint64_t ended;   /* instances whose programs were stopped (SCENE_PROGRAM_STEPS) */
};
