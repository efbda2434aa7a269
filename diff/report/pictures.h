/*
 * What was compared, as pictures: the layers of a traced frame, and maps of where it differs.
 */
#pragma once

#include "diff/baseline/baseline.h"
#include "diff/report/change.h"
#include "diff/report/output.h"
#include "diff/score/maps.h"
#include "diff/pictures/set.h"
#include "diff/rules/rules.h"

enum picture_kind {
	PICTURE_APPROVED,   /* the beauty that was approved, where it is stored and the frame is another one now */
	PICTURE_CHANGE,     /* the beauty against it, per channel, 8 times */
	PICTURE_CHANGED,    /* red: not as approved (gate B), over a dimmed approved frame */
	PICTURE_REFERENCE,  /* as recorded */
	PICTURE_COMPARED,   /* the compared layer: gl, or what --channel names */
	PICTURE_BEAUTY,
	PICTURE_DIFFERENCE, /* per channel, 8 times */
	PICTURE_FLIP,       /* compared layer against reference, on the map magma */
	PICTURE_FAILING,    /* red: fails R1, R1b or R2; blue: edge band; over a dimmed reference */
	PICTURE_SHADOW, PICTURE_RELIGHT, PICTURE_REFLECT, PICTURE_REFRACT,
	PICTURE_ALBEDO, PICTURE_NORMAL,
	PICTURE_DEPTH,      /* window depth, its range stretched over grey; near is bright */
	PICTURE_ID,         /* one colour for each draw */
	N_PICTURES
};

/** Short names, for file and programs: "reference", "compared", "beauty", ... */
extern const char *const picture_names[N_PICTURES];

/* What a report shows. */
struct picture_sources {
	const struct output_run *run; /* for what is compared and ignored */
	struct set *ref, *traced;     /* ref: without frames where there are only approved ones */
	const struct baseline *baseline; /* dir NULL: none */
};

/* One frame, with all that its pictures are made of. */
struct picture_frame {
	struct image ref_image, image;
	struct score_picture ref, compared; /* rgb NULL where there is no reference; ref has a size even so */
	struct score_maps maps; /* empty where the sizes differ, or there is no reference */
	struct change change;
	struct score_rules_frame settings;
	int is_beauty;          /* 1: there is no gl; the beauty was compared, and makes one picture, not two */
};

/**
 * Read one frame of all that there is.
 * @param out  all zero; free with picture_frame_free, also on failure
 * @return 0, ERR_INPUT (reported) or ERR_SYSTEM (reported)
 */
int picture_frame_read(const struct picture_sources *from, uint64_t frame, struct picture_frame *out);
void picture_frame_free(struct picture_frame *frame);

/** The reference as it is compared: layer `channel` if it has it, else gl, else its plain colours where these are all
 * it has. */
int picture_take_reference(const struct image *img, const char *channel, struct score_picture *out);

/**
 * Make one picture.
 * @param rgb            receives a buffer [height][width][3]; caller frees with free(). NULL where there is nothing to
 *                       show: no such channels, or an effect of one colour all over
 * @param width, height  receive its size: the reference's, or the traced frame's where the sizes differ
 * @return 0 or ERR_SYSTEM (reported)
 */
int picture_make(const struct picture_frame *frame, enum picture_kind kind, uint8_t **rgb, uint32_t *width,
                 uint32_t *height);
