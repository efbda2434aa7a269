/* Findings reach what applies them as the structs that their file would give (look/rules/findings.h). */
#include "look/rules/findings.h"

#include <stdlib.h>
#include <string.h>

#include "look/rules/rules.h"
#include "look/rules/schema.h"
#include "tests/case.h"

static void check_same(const void *a, const void *b, const cyaml_schema_field_t *fields);

static const void *member_of(const void *data, const cyaml_schema_field_t *field)
{
	const void *member;

	memcpy(&member, (const char *)data + field->data_offset, sizeof(member));
	return member;
}

static void check_list(const void *a, const void *b, const cyaml_schema_field_t *field)
{
	uint32_t n, n_b;

	memcpy(&n, (const char *)a + field->count_offset, sizeof(n));
	memcpy(&n_b, (const char *)b + field->count_offset, sizeof(n_b));
	ck_assert_msg(n == n_b, "%s: %u and %u", field->key, n, n_b);
	for (uint32_t i = 0; i < n; i++)
		check_same((const char *)member_of(a, field) + i * field->value.data_size,
		           (const char *)member_of(b, field) + i * field->value.data_size,
		           field->value.sequence.entry->mapping.fields);
}

static void check_same(const void *a, const void *b, const cyaml_schema_field_t *fields)
{
	for (const cyaml_schema_field_t *field = fields; field->key; field++) {
		const void *x = member_of(a, field), *y = member_of(b, field);
		const cyaml_schema_value_t *v = &field->value;

		if (v->type == CYAML_SEQUENCE) {
			check_list(a, b, field);
			continue;
		}
		ck_assert_msg(!x == !y, "%s is %s", field->key, x ? "missing in the file" : "in the file alone");
		if (!x)
			continue;
		if (v->type == CYAML_MAPPING)
			check_same(x, y, v->mapping.fields);
		else if (v->type == CYAML_STRING)
			ck_assert_str_eq(x, y);
		else
			ck_assert_msg(memcmp(x, y, v->data_size * (v->type == CYAML_SEQUENCE_FIXED ? v->sequence.max : 1)) == 0,
			              "%s differs", field->key);
	}
}

static const double third[4] = { 1 / 3.0, -2 / 3.0, 1e-7 / 3, 2000 / 3.0 };

/* Rules of every list and values of every type. */
static void fill(struct findings *out)
{
	static const uint64_t hash[2] = { 0x1d, 0xab00000000000000u };
	struct finding *f = findings_add(out, FINDINGS_SURFACES, "light of %s", "walls");
	struct finding_value at = { .key = "at", .type = FINDING_NUMBERS, .digits = 9, .n = 16 };

	finding_explain(f, 1 / 3.0, "%u of %u", 1, 3);
	FINDING_SET(f, FINDING_PLANE("plane", third));
	FINDING_MATCH(f, FINDING_HASHED("mesh", hash), FINDING_IS("lit", 0), FINDING_COUNTED("units", 2));
	FINDING_SET(f, FINDING_NAMED("passes", "suns and from behind"), FINDING_NUMBER("reflect", 4, third[0]));
	f = findings_add(out, FINDINGS_LIGHTS, "sun");
	finding_say(f, "it shines");
	FINDING_SET(f, FINDING_NAMED("space", "world"), FINDING_PLACE("position", -5, third, 0),
	            FINDING_VECTOR("diffuse", -3, third[0], 1, 0));
	f = findings_add(out, FINDINGS_SURFACES, "decal");
	FINDING_MATCH(f, FINDING_IS("lit", 0), FINDING_COUNTED("units", 1), FINDING_IS("blended", 1),
	              FINDING_IS("alpha_tested", 0), FINDING_IS("depth_tested", 1), FINDING_IS("stencil_tested", 0),
	              FINDING_IS("multiplies", 0), FINDING_PLANE("in_plane", third));
	f = findings_add(out, FINDINGS_UNSEEN, "out of sight");
	FINDING_SET(f, FINDING_COUNTED("frame", 12), { .key = "draws", .type = FINDING_QUOTED, .text = strdup("1-3,5-5") });
	f = findings_add(out, FINDINGS_SKY, "sky light");
	FINDING_SET(f, FINDING_NUMBER("reach", 4, third[3]), FINDING_VECTOR("up", -4, 0, 1, 0));
	f = findings_add(out, FINDINGS_GLOSS, "highlights");
	FINDING_SET(f, FINDING_NUMBER("share", 1, 1));
	for (int i = 0; i < 16; i++)
		at.numbers[i] = third[i % 4] * (i + 1);
	f = findings_add(out, FINDINGS_WORLD, NULL);
	FINDING_SET(f, FINDING_HASHED("mesh", hash), at, FINDING_COUNTED("part", 1));
}

static char *text_of(const struct findings *findings)
{
	char *text = NULL;
	size_t size;
	FILE *out = open_memstream(&text, &size);

	findings_write(findings, "a.trace", out);
	fclose(out);
	return text;
}

START_TEST(test_structs_are_those_of_the_file)
{
	struct findings findings = { .n = 0 };
	struct look *passed = NULL, *read = NULL;
	char *text;

	fill(&findings);
	ck_assert_int_eq(findings_check(&findings), 0);
	text = text_of(&findings);
	ck_assert_int_eq(rules_parse("text", text, strlen(text), &read), 0);
	ck_assert_int_eq(rules_from_findings("findings", &findings, &passed), 0);
	check_same(passed->rules, read->rules, rules_schema.mapping.fields);
	ck_assert_uint_eq(passed->rules->surfaces_count, 2);
	ck_assert_uint_eq(passed->unseen[0].draws.n_ranges, 2);
	rules_free(&passed);
	rules_free(&read);
	findings_free(&findings);
	free(text);
}
END_TEST

/* A match is one mapping, and a long one has two lines. */
START_TEST(test_the_file_reads_well)
{
	struct findings findings = { .n = 0 };
	char *text;

	fill(&findings);
	text = text_of(&findings);
	ck_assert_ptr_nonnull(strstr(
		text, "surfaces:\n"
		      "  - role: light of walls\n"
		      "    confidence: 0.33\n"
		      "    why: \"1 of 3\"\n"
		      "    plane: [0.3333333, -0.6666667, 3.333333e-08, 666.6667]\n"
		      "    match: { mesh: \"ab00000000000000000000000000001d\", lit: no, units: 2 }\n"
		      "    passes: suns and from behind\n"
		      "    reflect: 0.3333\n"
		      "  - role: decal\n"
		      "    match: { lit: no, units: 1, blended: yes, alpha_tested: no, depth_tested: yes,\n"
		      "             stencil_tested: no, multiplies: no, in_plane: "));
	ck_assert_ptr_nonnull(strstr(text, "    position: [0.33333, -0.66667, 0.00000, 0]\n"
	                                   "    diffuse: [0.333, 1.000, 0.000]\n"));
	ck_assert_ptr_nonnull(strstr(text, "sky:\n  role: sky light\n  reach: 666.7\n  up: [0.0000, 1.0000, 0.0000]\n"));
	findings_free(&findings);
	free(text);
	text = text_of(&findings);
	ck_assert_ptr_nonnull(strstr(text, "surfaces: []\nlights: []\n"));
	free(text);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("findings");

	tcase_add_test(tests, test_structs_are_those_of_the_file);
	tcase_add_test(tests, test_the_file_reads_well);
	return run_case(tests, "findings");
}
