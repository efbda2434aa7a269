/*
 * A user's hook: OpenCL C source whose functions replace stages of the wavefront. corpus/hooks/README.md documents it
 * for authors of hooks; kernels/frame/hook/hook.h calls the functions.
 *
 * Parameters are declared in the source, one per line, and set by rules (look/rules/rules.h):
 *
 *     #pragma relume parameter float bands = 3
 *     #pragma relume parameter color tint = 1 0.5 0
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"

/* X(NAME, function): stages that a hook may have; bits of hook.stages. */
#define HOOK_STAGES(X) \
	X(RAY_GENERATION, ray_generation) X(BOUNDS, bounds) X(INTERSECTION, intersection) X(ANY_HIT, any_hit) \
	X(CLOSEST_HIT, closest_hit) \
	X(MISS, miss) X(LIGHT, light)

enum {
#define HOOK_STAGE_NUMBER(name, function) HOOK_NUMBER_##name,
	HOOK_STAGES(HOOK_STAGE_NUMBER)
	N_HOOK_STAGES,
#define HOOK_STAGE_BIT(name, function) HOOK_##name = 1 << HOOK_NUMBER_##name,
	HOOK_STAGES(HOOK_STAGE_BIT)
};
extern const char *const hook_stage_names[N_HOOK_STAGES];

enum hook_type { HOOK_FLOAT, HOOK_INT, HOOK_COLOR, N_HOOK_TYPES };
extern const char *const hook_type_names[N_HOOK_TYPES];

struct hook_parameter {
	char name[48];
	enum hook_type type;
	unsigned words; /* words in a row: 1, or 3 for a colour */
	float initial[3];
};

#define HOOK_MAX_PARAMETERS 32

struct hook {
	const char *path;   /* borrowed */
	char *text;         /* owned; the source after a #line */
	char *declarations; /* prepended to the kernels: the stages that exist and the struct of parameters */
	unsigned stages;    /* HOOK_* */
	int asks_boxes;     /* it calls relume_box_tests */
	void *library;      /* library of host.h for the reference device, or NULL */
	struct hook_parameter parameters[HOOK_MAX_PARAMETERS];
	unsigned n_parameters, words; /* words: in a row of all parameters */
};

/**
 * Create a hook from its source.
 * @param path  file name for messages; kept until hook_free
 * @return as hook_load
 */
int hook_make(const char *path, const char *text, struct hook **out);

/**
 * Create a hook from a file.
 * @param path  kept until hook_free
 * @return 0, ERR_INPUT (reported with file and line) or ERR_SYSTEM (reported)
 */
int hook_load(const char *path, struct hook **out);
void hook_free(struct hook **hook);

/**
 * Fill a row of parameters: start with the defaults from the source, then apply each list in turn. Later lists win.
 * @param row  [words]
 */
void hook_start_row(const struct hook *hook, float *row);
void hook_fill_row(const struct hook *hook, const struct scene_parameter *list, uint32_t n, float *row);

/**
 * Check parameters set by rules: the hook declares each name, and the number of values matches.
 * @return 0 or ERR_INPUT (reported)
 */
int hook_check_parameters(const struct hook *hook, const struct scene_parameter *list, uint32_t n);
