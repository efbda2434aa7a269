/*
 * A frame prepared for the wavefront: scene instances with their matrices and flags, and the frame's events in order,
 * divided into segments. Each segment takes one camera pass.
 */
#pragma once

#include "kernels/shared.h"
#include "scene/scene.h"

/* Clears, then the instances of one view. */
struct segment {
	uint32_t clear_first, clear_count; /* range of scene.clears; executed first */
	uint32_t view;                     /* index in prepared.views, one view per segment; SCENE_NONE: clears only */
	uint32_t mode;                     /* CAMERA_*: nearest if that gives the same result, else columns */
	uint32_t instance_first, instance_count; /* range of prepared.instances; screen geometry comes last */
	uint32_t screen_count;
	uint32_t multisample; /* 1: its primitives cover samples, not pixels */
};

/* How an instance's primitives are rasterized (GL 2.1 sec. 3.5.4: polygon modes). */
enum prepared_shape { PREPARED_FILLED, PREPARED_LINES, PREPARED_POINTS };

struct prepared {
	struct segment *segments;
	uint32_t n_segments;

	/* [n_instances]: one of each for every instance. An instance appears twice if its faces have different polygon
	 * modes. primitive_first and the offsets of nodes and triangles are not set yet. */
	struct instance *instances;
	struct geometry *geometries;
	enum prepared_shape *shapes;
	uint32_t *culls; /* INSTANCE_CULL_* of instances to be expanded */
	uint32_t n_instances;

	struct view *views;             /* [n_views], one for each segment that draws */
	struct scene_view *scene_views; /* [n_views]: the scene's views; clears of the depth separate eye spaces */
	uint32_t n_views;

	uint32_t n_vertices;  /* vertices of all instances */
	uint32_t n_texcoords; /* [4] each */
	uint32_t *owner;      /* [n_vertices]: instance */
	uint8_t *skies;       /* [scene's instances]: 1 if the instance is a sky */
	uint8_t *depths;      /* [scene's instances]: 1 if it is solid and shows no colour (scene/depths.h) */
	uint32_t n_light_slots; /* most lights in any lit material */
	int has_vertex_programs, has_fragment_programs;
	int has_mirrors; /* 1: a surface reflects or transmits light */
	int has_transparency;   /* 1: a surface that stops a ray to a light may transmit some of it */
};

/**
 * Prepare a frame.
 * @param shift  moves the picture, in pixels, so that pixel centres sample other positions
 * @param out  all zero; filled on success; free with prepared_free
 * @return 0 or ERR_SYSTEM (reported)
 */
int prepare_frame(const struct scene *scene, const float shift[2], struct prepared *out);

/** 1 if a program computes the positions of an instance's vertices. */
int prepare_is_displaced(const struct scene *scene, const struct scene_instance *instance);

/** Place a filled instance by its modelview. Bake it if the modelview has no inverse or is projective. */
void prepare_place(struct prepared *p, const struct scene *scene, uint32_t instance);

/** Set the amount that camera rays widen an instance's boxes by (struct instance). positions: in object space, or in
 * eye space if it is baked. */
void prepare_pad(struct prepared *p, uint32_t instance, const float (*positions)[4], uint32_t n);

/** Move the picture of a prepared frame: set its views as prepare_frame would with this shift. */
void prepare_shift(struct prepared *p, const float shift[2]);
void prepared_free(struct prepared *p);

/** The first segment of the eye space with most instances. @return NULL: there is nothing to hit in any */
const struct segment *prepare_main_segment(const struct prepared *p);

/** Set a geometry's offsets to the arrays of a mesh within its block of words, starting at `base`. */
void prepare_layout(const struct scene_mesh *mesh, uint32_t base, struct geometry *g);

/** Size in words of a mesh's vertex arrays; of its indices. */
size_t prepare_attribute_words(const struct scene_mesh *mesh);
size_t prepare_index_words(const struct scene_mesh *mesh);

/** pool_fill functions for both; object is a struct scene_mesh. */
void prepare_fill_attributes(const void *object, uint32_t *words);
void prepare_fill_indices(const void *object, uint32_t *words);
