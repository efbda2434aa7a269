/*
 * The command line of `relume render`, and a hash of everything in it that affects pictures.
 *
 * settings.c lists the options in one table. An option changes pictures unless its row says that it does not, so a new
 * one is part of the hash by default.
 */
#pragma once

#include "base/frames.h"
#include "base/options.h"
#include "base/progress.h"
#include "tracer/frame/trace.h"
#include "tracer/image/display.h"
#include "verbs/render/moments.h"

enum { SETTINGS_MOST_LOOKS = 16 };

struct settings {
	const char *trace, *output, *device;
	unsigned threads, jobs; /* 0: as many as the machine has */
	int family; /* traversal kernels, enum device_family; -1: those that suit each device */
	struct frame_list frames;
	uint64_t chunk, n_chunks; /* n_chunks 0: all */
	int skip_existing, dry_run, allow_incomplete;
	uint64_t memory_bytes;  /* 0: no limit */
	double frame_s;         /* 0: no limit */
	double driver_s;        /* limit for a call of OpenCL */
	enum progress_style progress;
	const char *cache;      /* folder for trees of meshes and compiled kernels; NULL: the user's */
	int no_cache;
	uint64_t cache_bytes;   /* its limit; 0: BLAS_STORE_BYTES */
	struct look *look;       /* rules of all --look, in order; those of "auto" once it is studied */
	struct look *look_after; /* rules of files after "auto", until then */
	const char *looks[SETTINGS_MOST_LOOKS]; /* as typed */
	unsigned n_looks;
	struct hook *hook;      /* owned; NULL: none */
	int look_auto;          /* 1: the rules come from a study of the recording */
	struct camera *camera;  /* owned; NULL: the recorded one */
	float scale;            /* pixels for each pixel of the window; 0: recorded size, or `size` */
	uint32_t size[2];       /* pixels of pictures; 0: not given */
	float fps, recorded_fps, shutter; /* 0: not given */
	struct moments moments; /* the pictures' moments; with fps and turntables `frames` are pictures (render.c) */
	struct tracer_options tracer;
	char *aov;                      /* owned: the part of --aov that the tracer makes; NULL: all */
	int motion;                     /* 1: channels that verbs/render/vectors.h adds */
	int caustics;                   /* 1: channels that tracer/frame/light/photons.h adds */
	unsigned photons;               /* for caustics; 0: the default number */
	int denoise;                    /* 1: each frame is denoised separately (settings_denoise) */
	int oidn;                       /* 1: with Open Image Denoise */
	const char *preview;            /* file names of previews; NULL: none */
	int cryptomatte;                /* 1: channels that verbs/render/cryptomatte.h adds */
	enum display_kind kind;         /* kind of the files */
	struct display_options display; /* options for display pictures */
	struct options_line line; /* for settings_confine */
	char hash[33]; /* hash of all that affects pictures but trace and version; explicit defaults too */
};

/** 1 if pictures have another size than the recorded window. */
int settings_resize(const struct settings *s);

/**
 * Parse a command line.
 * @param s  zero-initialised; strings are borrowed from argv; settings_free
 * @return 0; 1 if help was printed; ERR_USAGE, ERR_INPUT or ERR_SYSTEM (reported)
 */
int settings_parse(struct settings *s, int argc, char **argv);

/** Open the files needed beside the recording, and drop all rights that the command line does not need. @return 0 or
 * ERR_SYSTEM (reported) */
int settings_confine(const struct settings *s);
void settings_free(struct settings *s);

/** 1 if scenes between recorded frames are needed. */
int settings_mixes(const struct settings *s);

/** 1 if pictures are numbered from 0, whatever the recorded frame: for a turntable, or with fps. */
int settings_number_pictures(const struct settings *s);

/** The recorded frame that a picture shows: its own, that of a turntable, or the one nearest to its moment. Known
 * once `moments` are. */
uint64_t settings_recorded_frame(const struct settings *s, uint64_t number);

/** Denoise a frame, if asked for. @return 0 or ERR_SYSTEM (reported) */
int settings_denoise(const struct settings *s, struct image *img);

/** Names of modes for --mode, by enum tracer_mode; ended by NULL. */
extern const char *const settings_mode_names[];
