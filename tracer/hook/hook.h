/*
 * A user's hook: OpenCL C text whose functions stand in for stages of the wavefront. corpus/hooks/README.md is what its
 * author reads; kernels/frame/hook.h calls the functions.
 *
 * Parameters are declared in the text, a line each, and set by rules (look/rules/rules.h):
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
	unsigned words; /* of a row: 1, or 3 of a colour */
	float initial[3];
};

#define HOOK_MAX_PARAMETERS 32

struct hook {
	const char *path;   /* borrowed */
	char *text;         /* its own, behind a #line */
	char *declarations; /* to stand before the kernels: which stages there are, and the struct of parameters */
	unsigned stages;    /* HOOK_* */
	int asks_boxes;     /* it calls relume_box_tests */
	void *library;      /* of host.h, for the reference device; or NULL */
	struct hook_parameter parameters[HOOK_MAX_PARAMETERS];
	unsigned n_parameters, words; /* words: of a row of all parameters */
};

/**
 * Make one of a text.
 * @param path  that messages name; kept until hook_free
 * @return as hook_load
 */
int hook_make(const char *path, const char *text, struct hook **out);

/**
 * Read a file.
 * @param path  kept until hook_free
 * @return 0, ERR_INPUT (reported: the file, its line) or ERR_SYSTEM (reported)
 */
int hook_load(const char *path, struct hook **out);
void hook_free(struct hook **hook);

/**
 * A row of parameters: what the text says, then what lists say, the last one last.
 * @param row  [words]
 */
void hook_start_row(const struct hook *hook, float *row);
void hook_fill_row(const struct hook *hook, const struct scene_parameter *list, uint32_t n, float *row);

/**
 * Check what rules set: each name is known to the hook and has as many numbers as it takes.
 * @return 0 or ERR_INPUT (reported)
 */
int hook_check_parameters(const struct hook *hook, const struct scene_parameter *list, uint32_t n);
