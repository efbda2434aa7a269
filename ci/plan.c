/* Reads relume-ci.yaml and checks its programs. */
#include "ci/plan.h"

#include <stdlib.h>
#include <string.h>

#include "base/config.h"
#include "base/err.h"

#define OPTIONAL (CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL)
#define TEXT(type, member) CYAML_FIELD_STRING_PTR(#member, OPTIONAL, type, member, 1, CYAML_UNLIMITED)
#define TEXTS(member, flags, least) \
	CYAML_FIELD_SEQUENCE_COUNT(#member, flags, struct ci_program, member, n_##member, &text, least, CYAML_UNLIMITED)

static const cyaml_schema_value_t text = { CYAML_VALUE_STRING(CYAML_FLAG_POINTER, char *, 0, CYAML_UNLIMITED) };

static const cyaml_schema_field_t program_fields[] = {
	TEXT(struct ci_program, name), TEXTS(command, CYAML_FLAG_POINTER, 1), TEXTS(environment, OPTIONAL, 0),
	TEXTS(press, OPTIONAL, 0), TEXTS(data, OPTIONAL, 0), TEXT(struct ci_program, config),
	CYAML_FIELD_UINT("frames", CYAML_FLAG_OPTIONAL, struct ci_program, frames), CYAML_FIELD_END
};

static const cyaml_schema_value_t program = {
	CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct ci_program, program_fields)
};

static const cyaml_schema_field_t plan_fields[] = {
	TEXT(struct ci_plan, baseline),
	CYAML_FIELD_SEQUENCE_COUNT("programs", CYAML_FLAG_POINTER, struct ci_plan, programs, n_programs, &program, 1,
	                           CYAML_UNLIMITED),
	CYAML_FIELD_END
};

static const cyaml_schema_value_t plan_schema = {
	CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, struct ci_plan, plan_fields)
};

/* 1 if a text can be a program's name. */
static int is_name(const char *name)
{
	static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._+-";

	return *name && name[0] != '.' && name[0] != '-' && name[strspn(name, letters)] == '\0';
}

int ci_program_check(struct ci_program *p, const char *where)
{
	const int wrong = where ? ERR_INPUT : ERR_USAGE;
	const char *slash = strrchr(p->command[0], '/');

	if (!p->name && !(p->name = strdup(slash ? slash + 1 : p->command[0])))
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!is_name(p->name))
		return err_report(wrong, where, "'%s' cannot be the name of a program's results: give it one of letters, "
		                  "digits and . _ + -%s", p->name, where ? " (name: NAME)" : " (-n NAME)");
	for (uint32_t i = 0; i < p->n_environment; i++)
		if (!strchr(p->environment[i], '=') || p->environment[i][0] == '=')
			return err_report(wrong, where, "%s: environment: '%s' is not NAME=VALUE", p->name, p->environment[i]);
	if (!p->frames)
		p->frames = CI_FRAMES;
	return p->frames <= CI_MOST_FRAMES ? 0
		: err_report(wrong, where, "%s: at most %d frames", p->name, CI_MOST_FRAMES);
}

int ci_plan_read(const char *path, struct ci_plan **out)
{
	struct ci_plan *plan = NULL;
	int err = config_load(path, &plan_schema, (void **)&plan);

	for (uint32_t i = 0; !err && i < plan->n_programs; i++) {
		err = ci_program_check(&plan->programs[i], path);
		for (uint32_t k = 0; !err && k < i; k++)
			if (strcmp(plan->programs[k].name, plan->programs[i].name) == 0)
				err = err_report(ERR_INPUT, path, "two programs are called '%s'", plan->programs[i].name);
	}
	*out = plan;
	return err;
}

void ci_plan_free(struct ci_plan **plan)
{
	config_free(&plan_schema, *plan);
	*plan = NULL;
}
