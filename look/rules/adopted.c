#include "look/rules/adopted.h"

#include <assert.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/hash.h"
#include "look/rules/schema.h"

/* The field of a key, which must exist; the list ends at a NULL key. */
static const cyaml_schema_field_t *field_of(const cyaml_schema_field_t *fields, const char *key)
{
	while (fields->key && strcmp(fields->key, key) != 0)
		fields++;
	assert(fields->key);
	return fields;
}

/*
 * Numbers rounded as a rule file would round them: printed, and parsed again. Then adopted rules and written ones give
 * the same pictures (findings.h). NULL: out of memory
 */
static float *numbers_of(const struct finding_value *v)
{
	const unsigned n = v->n ? v->n : 1; /* 0: a single number, not a list */
	float *out = malloc(n * sizeof(*out));
	char text[64];

	for (unsigned i = 0; i < n && out; i++) {
		finding_print_number(v, i, text);
		out[i] = strtof(text, NULL);
	}
	return out;
}

static void *copy(const void *data, size_t n)
{
	void *out = malloc(n);

	return out ? memcpy(out, data, n) : NULL;
}

/* A value as struct rules points to it: allocated, in the type of its key's schema. NULL: out of memory */
static void *value_of(const struct finding_value *v)
{
	char hash[33];

	switch (v->type) {
	case FINDING_TRUTH: return copy(&(bool){ v->count != 0 }, sizeof(bool));
	case FINDING_COUNT: return copy(&(uint32_t){ (uint32_t)v->count }, sizeof(uint32_t));
	case FINDING_NUMBERS: return numbers_of(v);
	case FINDING_HASH:
		hash_text(v->hash, hash);
		return strdup(hash);
	case FINDING_WORD: return strdup(v->word);
	default: return strdup(v->text);
	}
}

/* The pointer in a struct that a schema describes as `field`. */
static void *member_get(const void *data, const cyaml_schema_field_t *field)
{
	void *member;

	memcpy(&member, (const char *)data + field->data_offset, sizeof(member));
	return member;
}

/* Set that pointer. */
static void member_set(void *data, const cyaml_schema_field_t *field, void *member)
{
	memcpy((char *)data + field->data_offset, &member, sizeof(member));
}

/*
 * Set one key of a rule, or of its `match`, which is allocated for its first test.
 * @param fields  the schema of the rule
 * @return 0 or ERR_SYSTEM (reported)
 */
static int set_value(void *rule, const cyaml_schema_field_t *fields, const struct finding_value *v)
{
	const cyaml_schema_field_t *field;

	if (v->is_match) {
		field = field_of(fields, "match");
		if (!member_get(rule, field))
			member_set(rule, field, calloc(1, field->value.data_size));
		rule = member_get(rule, field);
		fields = field->value.mapping.fields;
	}
	if (!rule)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	field = field_of(fields, v->key);
	member_set(rule, field, value_of(v));
	return member_get(rule, field) ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
}

/* Convert the findings of one list: to an array of rules, or to a single rule if the key takes no list (sky, gloss). */
static int fill_list(struct rules *rules, const struct findings *findings, enum findings_list list)
{
	const cyaml_schema_field_t *field = field_of(rules_schema.mapping.fields, findings_key(list)), *fields;
	uint32_t n = 0;
	char *array;
	int err = 0;

	for (size_t i = 0; i < findings->n; i++)
		n += findings->list[i].list == list;
	if (!n)
		return 0;
	array = calloc(n, field->value.data_size);
	if (!array)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	member_set(rules, field, array);
	fields = field->value.mapping.fields;
	if (field->value.type == CYAML_SEQUENCE) {
		memcpy((char *)rules + field->count_offset, &n, sizeof(n));
		fields = field->value.sequence.entry->mapping.fields;
	}
	for (size_t i = 0, at = 0; i < findings->n && !err; i++) {
		const struct finding *f = &findings->list[i];

		for (unsigned k = 0; k < f->n && !err && f->list == list; k++)
			err = set_value(array + at * field->value.data_size, fields, &f->values[k]);
		at += f->list == list;
	}
	return err;
}

int adopted_create(const struct findings *findings, struct rules **out)
{
	const struct finding_value replace = FINDING_IS("replace", 1); /* as findings_write does */
	struct rules *rules = calloc(1, sizeof(*rules));
	int err = rules ? set_value(rules, rules_schema.mapping.fields, &replace) :
	                  err_report(ERR_SYSTEM, NULL, "out of memory");

	for (int l = 0; l < N_FINDINGS_LISTS && !err; l++)
		err = fill_list(rules, findings, (enum findings_list)l);
	if (err) {
		config_free(&rules_schema, rules);
		rules = NULL;
	}
	*out = rules;
	return err;
}
