/*
 * What `relume render` was asked for: its command line, and the name by content of all that decides about pictures.
 *
 * settings.c lists the options in one table. An option changes pictures unless its row says otherwise, so a new one is
 * part of the name by default.
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
	unsigned threads, jobs; /* 0: as the machine has */
	int family; /* of traversal kernels, enum device_family; -1: what suits each device */
	struct frame_list frames;
	uint64_t chunk, n_chunks; /* n_chunks 0: all */
	int skip_existing, dry_run, allow_incomplete;
	uint64_t memory_bytes;  /* 0: no limit */
	double frame_s;         /* 0: no limit */
	double driver_s;        /* of a call of OpenCL */
	enum progress_style progress;
	const char *cache;      /* folder for trees of meshes and compiled kernels; NULL: the user's */
	int no_cache;
	uint64_t cache_bytes;   /* what it may hold; 0: BLAS_STORE_BYTES */
	struct look *look;       /* rules of all --look, in order; those of "auto" when the recording has been studied */
	struct look *look_after; /* of files behind "auto", until then */
	const char *looks[SETTINGS_MOST_LOOKS]; /* as typed */
	unsigned n_looks;
	struct hook *hook;      /* owned; NULL: none */
	int look_auto;          /* 1: the rules are what a study of the recording finds */
	struct camera *camera;  /* owned; NULL: the recorded one */
	float scale;            /* pixels for one of the window's; 0: as many as recorded, or `size` */
	uint32_t size[2];       /* pixels of pictures; 0: not given */
	float fps, recorded_fps, shutter; /* 0: not given */
	struct moments moments; /* of pictures, which `frames` are with fps and of a turntable (render.c) */
	struct tracer_options tracer;
	char *aov;                      /* owned: what of --aov the tracer makes; NULL: all */
	int motion;                     /* 1: channels that verbs/render/vectors.h adds */
	int caustics;                   /* 1: channels that tracer/frame/photons.h adds */
	unsigned photons;               /* for them; 0: as many as by default */
	int denoise;                    /* 1: noise is taken out of each frame by itself (settings_denoise) */
	int oidn;                       /* 1: by Open Image Denoise */
	const char *preview;            /* file names of pictures of the samples so far; NULL: none */
	int cryptomatte;                /* 1: channels that verbs/render/cryptomatte.h adds */
	enum display_kind kind;         /* of the files */
	struct display_options display; /* of display pictures */
	struct options_line line; /* for settings_confine */
	char hash[33]; /* of everything that decides about pictures but the trace and the version; explicit defaults count */
};

/** 1 where pictures have another size than the recorded window. */
int settings_resize(const struct settings *s);

/**
 * Parse a command line.
 * @param s  zero-initialised; strings are borrowed from argv; settings_free
 * @return 0; 1 where help was printed; ERR_USAGE, ERR_INPUT or ERR_SYSTEM (reported)
 */
int settings_parse(struct settings *s, int argc, char **argv);

/** Open what is needed beside the recording, and give up all rights but those that the command line asks for. @return 0
 * or ERR_SYSTEM (reported) */
int settings_confine(const struct settings *s);
void settings_free(struct settings *s);

/** 1 where scenes between recorded frames are made. */
int settings_mixes(const struct settings *s);

/** 1 where pictures are numbered from 0, whatever the recorded frame: of a turntable, or with fps. */
int settings_number_pictures(const struct settings *s);

/** The frame of the recording that a picture shows: its own, that of a turntable, or the one nearest to its moment.
 * Known once `moments` are. */
uint64_t settings_recorded_frame(const struct settings *s, uint64_t number);

/** Take the noise out of a frame, where that is asked for. @return 0 or ERR_SYSTEM (reported) */
int settings_denoise(const struct settings *s, struct image *img);

/** What --mode takes, by enum tracer_mode; ended by NULL. */
extern const char *const settings_mode_names[];
