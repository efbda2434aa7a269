#include "look/camera/programs.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/mat4.h"
#include "look/draws/drawn.h"
#include "scene/program.h"

enum {
	COLUMNS = 5,
	MOVING = COLUMNS
}; /* numbers of the function, the last of them constant; instructions: one for each other number, and one that sets
      the position */

static const struct scene_program *program_of(const struct scene *s, const struct scene_instance *in)
{
	const uint32_t program = s->materials[in->material].vertex_program;

	return program ? (const struct scene_program *)(s->programs + (program - 1)) : NULL;
}

int programs_place(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_program *p = program_of(s, in);

	return p && p->outputs >> SCENE_RESULT_POSITION & 1;
}

/* Eye positions as a function of clip positions, as in the vertex stage (kernels/gl/vertex_program.h): eye = columns
 * . (x, y, z, w, 1). @return 0: there is none */
static int find_eye(const struct scene_view *view, float eye[COLUMNS][4])
{
	const float *m = view->projection;
	float inverse[16], across[16], back[16];

	memset(eye, 0, COLUMNS * sizeof(*eye));
	if (drawn_in_parallel(view)) {
		if (!mat4_invert(inverse, m) || memcmp(m, mat4_identity, sizeof(mat4_identity)) == 0)
			return 0;
		for (int c = 0; c < 4; c++)
			memcpy(eye[c], inverse + 4 * c, sizeof(eye[c]));
		return 1;
	}
	/* rows x, y and w alone, with 1 as the fourth number; depth plays no part */
	for (int c = 0; c < 4; c++) {
		across[4 * c] = m[4 * c];
		across[4 * c + 1] = m[4 * c + 1];
		across[4 * c + 2] = m[4 * c + 3];
		across[4 * c + 3] = c == 3;
	}
	if (!mat4_invert(back, across))
		return 0;
	memcpy(eye[0], back, sizeof(eye[0]));
	memcpy(eye[1], back + 4, sizeof(eye[1]));
	memcpy(eye[3], back + 8, sizeof(eye[3]));
	memcpy(eye[4], back + 12, sizeof(eye[4]));
	return 1;
}

int programs_can_move(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_program *p = program_of(s, in);
	float eye[COLUMNS][4];

	return p->n_registers + 4 <= SCENE_PROGRAM_REGISTERS && p->n_instructions + MOVING <= SCENE_PROGRAM_INSTRUCTIONS &&
	       find_eye(&s->views[in->view], eye);
}

int programs_copy(const struct scene *s, struct scene *out)
{
	out->programs = malloc((s->n_programs + (size_t)1) * sizeof(*out->programs));
	if (!out->programs)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	if (s->n_programs)
		memcpy(out->programs, s->programs, s->n_programs * sizeof(*out->programs));
	return 0;
}

/* position = sum of column c times the position's number c, computed separately, in four extra registers */
static void write_moving(const struct scene_program *was, struct scene_instruction out[MOVING])
{
	const uint32_t own = was->n_registers, first = SCENE_PROGRAM_CONSTANT + was->n_constants;

	for (uint32_t c = 0; c < COLUMNS - 1; c++)
		out[c] = (struct scene_instruction){
			.operation = SCENE_OP_MAD, .n = 4, .flags = SCENE_STEP_B | SCENE_STEP_C | SCENE_UNMASKED, .to = own,
			.a = SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_POSITION + c, .b = first + 4 * c,
			.c = c ? own : first + 4 * (COLUMNS - 1)
		};
	out[COLUMNS - 1] = (struct scene_instruction){ .operation = SCENE_OP_MOVE,
		                                       .n = 4,
		                                       .flags = SCENE_STEP_A | SCENE_UNMASKED,
		                                       .to = SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_POSITION,
		                                       .a = own };
}

int programs_move(const struct scene *s, const struct scene_instance *in, const float moved[16],
                  const float projection[16], struct scene *out, struct scene_instance *to)
{
	const struct scene_program *was = program_of(s, in);
	const size_t old_head = sizeof(*was) + was->n_instructions * sizeof(struct scene_instruction);
	const size_t rest = was->n_lights * sizeof(struct scene_program_light) + was->n_constants * sizeof(float);
	const size_t bytes = old_head + MOVING * sizeof(struct scene_instruction) + rest + COLUMNS * 4 * sizeof(float);
	uint32_t *words = realloc(out->programs, (out->n_programs + (size_t)1) * sizeof(*words) + bytes);
	struct scene_instruction moving[MOVING];
	float eye[COLUMNS][4], clip_from_eye[16], columns[COLUMNS][4];
	struct scene_program head = *was;
	uint8_t *at;

	if (!words)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	out->programs = words;
	find_eye(&s->views[in->view], eye);
	mat4_mul(clip_from_eye, projection, moved);
	for (int c = 0; c < COLUMNS; c++)
		mat4_transform(columns[c], clip_from_eye, eye[c]);
	write_moving(was, moving);
	head.n_instructions += MOVING;
	head.n_registers += 4;
	head.n_constants += COLUMNS * 4;
	at = (uint8_t *)(words + out->n_programs);
	memcpy(at, &head, sizeof(head));
	memcpy(at + sizeof(head), was + 1, old_head - sizeof(head));
	memcpy(at + old_head, moving, MOVING * sizeof(*moving));
	memcpy(at + old_head + MOVING * sizeof(*moving), (const uint8_t *)was + old_head, rest);
	memcpy(at + bytes - sizeof(columns), columns, sizeof(columns));
	out->materials[out->n_materials] = out->materials[to->material];
	out->materials[out->n_materials].vertex_program = out->n_programs + 1;
	to->material = out->n_materials++;
	out->n_programs += (uint32_t)(bytes / sizeof(*words));
	return 0;
}
