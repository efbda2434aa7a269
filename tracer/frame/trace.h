/*
 * The wavefront: a scene becomes a picture on a device.
 *
 * Per frame: vertex stage, acceleration structures, then band by band of rows. Buffers of pixels and of their fragments
 * have a band's size: they stay in a CPU's caches, and memory does not grow with the frame. Within a band segment
 * follows segment (prepare.h) in draw order. A segment clears, traces camera rays, gathers and shades fragments, lights
 * those again whose shadow rays were stopped, follows mirrors, and puts all through the per-fragment operations. A
 * column of more fragments than one camera pass delivers takes several passes.
 */
#pragma once

#include "scene/scene.h"
#include "tracer/accel/accel.h"
#include "tracer/device/device.h"
#include "tracer/hook/hook.h"
#include "tracer/image/image.h"

enum tracer_mode {
	TRACER_WHITTED,  /* GL's picture, shadows, mirrors, glass */
	TRACER_GL,       /* GL's picture alone: beauty equals gl */
	TRACER_NORMALS,  /* eye-space normals as colours */
	TRACER_AO,       /* how open each surface is, as grey */
	TRACER_AO_PHONG, /* the same over GL's picture */
	TRACER_DIFFUSE,  /* whitted, and one bounce of light from surface to surface */
	TRACER_PATH      /* light followed from surface to surface, no ambient light; linear but where `display` says
	                    otherwise */
};

struct tracer_options {
	enum tracer_mode mode;
	int display;      /* 1: channels keep GL's display-referred numbers; 0: linear light */
	unsigned depth;   /* bounces at most */
	unsigned samples; /* of a pixel, which is their mean; spread differently in each (kernels/frame/sample.h); 0
	                     counts as 1 */
	double seconds;   /* where above 0, no sample begins that would end later; the picture then depends on time */
	float noise;      /* where above 0, none begins once the picture is less noisy than this (noise.h) */
	/* Where not NULL, shown a whole picture of the samples so far, now and then. @return 0, or ERR_* (reported),
	 * which ends the frame */
	int (*preview)(void *user, struct image *img);
	void *preview_user;
	/* Where not NULL, told after each sample how many there are. of: 0 where time or noise decides */
	void (*sampled)(void *user, uint32_t done, uint32_t of);
	void *sampled_user;
	/* Gives the scene that a sample shows, or NULL: all show one. away: share of the time that the shutter is open,
	 * [-0.5,0.5) from its middle. The scene has the frame's size, and lives until the next is asked for. @return 0 or
	 * ERR_* (reported) */
	int (*expose)(void *user, double away, const struct scene **scene);
	void *expose_user;
	unsigned rays;    /* rays to each light that has a size, and into the surroundings, a sample; 0 counts as 16 */
	float clamp;      /* of mode path: the most light that a path may bring, but by one mirror or glass alone; 0: no
	                     bound */
	float reach;      /* of openness, eye-space units; 0: without end */
	enum accel_kind accel; /* trees of meshes */
	int accel_asked;       /* 0: nobody asked for these; they are kd-trees where the program called rtBuildKdTreeEXT */
	struct blas_store *store; /* where these are kept for other runs, or NULL; kept until the last tracer_render
	                             returns */
	unsigned band_rows; /* rows of pixels that are drawn at a time; 0: as suits the device. The picture does not
	                       depend on it */
	int relight;      /* 1: lit at each pixel (Phong), not between vertices */
	const struct hook *hook; /* a user's functions at its stages, or NULL; the device has taken it (device_take_hook) */
	unsigned photons; /* sent for channels caustics.*, whatever aov lists (photons.h); 0: there are none */
	int counts;       /* 1: count what tracing adds (tracer_added) */
	const char *aov;  /* channel groups to store, with commas ("gl,shadow,N"); NULL: all. R G B A always are */
};

struct tracer;

/** @param dev  kept until tracer_destroy. @return 0 or ERR_SYSTEM (reported) */
int tracer_create(struct tracer **out, struct device *dev);
void tracer_destroy(struct tracer **tracer);

/** Share trees of meshes with other tracers of the process from now on. @param cache  kept until tracer_destroy */
void tracer_share(struct tracer *tracer, struct blas_cache *cache);

/** 0, or ERR_USAGE (reported) where a list of channel groups names one that is not there. */
int tracer_check_aov(const char *aov);

/**
 * Render one frame.
 * @param img  empty; receives the channels, and the attributes that the scene and device know (relume:frame,
 *             relume:device, relume:encoding, camera); free with image_free
 * @return 0 or ERR_SYSTEM (reported)
 */
int tracer_render(struct tracer *tracer, const struct scene *scene, const struct tracer_options *options,
                  struct image *img);

/**
 * What GL drew of a scene, as pixels: rounded to the frame buffer's bits, no shadows, no mirrors.
 * @param picture  of the scene's size, arrays allocated; filled
 * @return 0 or ERR_SYSTEM (reported)
 */
int tracer_render_picture(struct tracer *tracer, const struct scene *scene, struct scene_picture *picture);

/* What tracing adds to OpenGL's picture, by the channels that hold it. */
enum tracer_part { TRACER_SHADOWS, TRACER_RELIGHT, TRACER_MIRRORS, TRACER_GLASS, N_TRACER_PARTS };

/* Pixels so far that show it, of frames whose options counted them, in modes whitted, diffuse and path. */
struct tracer_added {
	uint64_t pixels;                /* in all */
	uint64_t parts[N_TRACER_PARTS]; /* that show each part */
	uint64_t changed;               /* any of them */
};
const struct tracer_added *tracer_added(const struct tracer *tracer);

/** Add to a sum what has come between two moments. */
void tracer_added_add(struct tracer_added *sum, const struct tracer_added *now, const struct tracer_added *before);

/** What was met so far that the tracer does not draw; all 0 where everything is drawn. */
struct tracer_undrawn {
	uint64_t targets; /* instances that drew to a target other than the window */
	uint64_t ended;   /* instances whose programs were ended (SCENE_PROGRAM_STEPS) */
};
const struct tracer_undrawn *tracer_undrawn(const struct tracer *tracer);
