/* Pictures of a comparison: the layers of a traced frame, and maps of its differences. */
#pragma once

#include "diff/baseline/baseline.h"
#include "diff/report/change.h"
#include "diff/report/output.h"
#include "diff/score/maps.h"
#include "diff/pictures/set.h"
#include "diff/rules/rules.h"

enum picture_kind {
	PICTURE_APPROVED,   /* approved beauty, if stored and the frame has changed */
	PICTURE_CHANGE,     /* change of the beauty per channel, times 8 */
	PICTURE_CHANGED,    /* red: differs from the approved frame (gate B), over a dimmed approved frame */
	PICTURE_REFERENCE,  /* as recorded */
	PICTURE_COMPARED,   /* the compared layer: gl, or that of --channel */
	PICTURE_BEAUTY,
	PICTURE_DIFFERENCE, /* per channel, times 8 */
	PICTURE_FLIP,       /* compared layer against reference, in magma colours */
	PICTURE_FAILING,    /* red: fails R1, R1b or R2; blue: edge band; over a dimmed reference */
	PICTURE_SHADOW, PICTURE_RELIGHT, PICTURE_REFLECT, PICTURE_REFRACT,
	PICTURE_ALBEDO, PICTURE_NORMAL,
	PICTURE_DEPTH,      /* window depth, its range stretched over grey; near is bright */
	PICTURE_ID,         /* one colour for each draw */
	N_PICTURES
};

/** Short names, for files and programs: "reference", "compared", "beauty", ... */
extern const char *const picture_names[N_PICTURES];

/* Sources of a report's pictures. */
struct picture_sources {
	const struct output_run *run; /* settings: what is compared and ignored */
	struct set *ref, *traced;     /* ref: empty if there are only approved frames */
	const struct baseline *baseline; /* dir NULL: none */
};

/* One frame with the data of its pictures. */
struct picture_frame {
	struct image ref_image, image;
	struct score_picture ref, compared; /* rgb NULL without a reference; ref still has a size */
	struct score_maps maps; /* empty if sizes differ or there is no reference */
	struct change change;
	struct score_rules_frame settings;
	int is_beauty;          /* 1: there is no gl layer; the beauty was compared and makes one picture, not two */
};

/**
 * Read all data of one frame.
 * @param out  all zero; free with picture_frame_free, also on failure
 * @return 0, ERR_INPUT (reported) or ERR_SYSTEM (reported)
 */
int picture_frame_read(const struct picture_sources *from, uint64_t frame, struct picture_frame *out);
void picture_frame_free(struct picture_frame *frame);

/** The layer of the reference to compare: `channel` if it has it, else gl, else its plain colours if it has nothing
 * else. */
int picture_take_reference(const struct image *img, const char *channel, struct score_picture *out);

/**
 * Make one picture.
 * @param rgb            receives a buffer [height][width][3]; caller frees. NULL if there is nothing to show: the
 *         channels are missing, or an effect has one colour all over
 * @param width, height  receive its size: the reference's, or the traced frame's if sizes differ
 * @return 0 or ERR_SYSTEM (reported)
 */
int picture_make(const struct picture_frame *frame, enum picture_kind kind, uint8_t **rgb, uint32_t *width,
                 uint32_t *height);
