/* Configuration files: errors name their line, and a file with errors is not used in part. */
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/config.h"
#include "base/err.h"
#include "tests/case.h"
#include "tests/said.h"

struct rule {
	char *match;
	double warn;
};

struct sheet {
	char *name;
	struct rule *rules;
	unsigned n_rules;
};

static const cyaml_schema_field_t rule_fields[] = {
	CYAML_FIELD_STRING_PTR("match", CYAML_FLAG_POINTER, struct rule, match, 0, CYAML_UNLIMITED),
	CYAML_FIELD_FLOAT("warn", CYAML_FLAG_OPTIONAL, struct rule, warn),
	CYAML_FIELD_END
};
static const cyaml_schema_value_t rule_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct rule, rule_fields) };
static const cyaml_schema_field_t sheet_fields[] = {
	CYAML_FIELD_STRING_PTR("name", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, struct sheet, name, 0, CYAML_UNLIMITED),
	CYAML_FIELD_SEQUENCE_COUNT("rules", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, struct sheet, rules, n_rules,
	                           &rule_schema, 0, CYAML_UNLIMITED),
	CYAML_FIELD_END
};
static const cyaml_schema_value_t schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, struct sheet, sheet_fields) };

static char path[] = "/tmp/relume-config-XXXXXX", said[1000];

/** Load text as a file; messages are stored in `said`. */
static int load(const char *text, void **out)
{
	struct said reported;
	int err;

	said_write_file(path, text);
	reported = said_begin();
	err = config_load(path, &schema, out);
	said_end(&reported, said, sizeof(said));
	return err;
}

START_TEST(a_good_file)
{
	void *data;

	ck_assert_int_eq(load("name: a\nrules:\n- match: 'x*'\n  warn: 0.5\n- match: y\n", &data), 0);
	struct sheet *s = data;

	ck_assert_str_eq(s->name, "a");
	ck_assert_uint_eq(s->n_rules, 2);
	ck_assert_str_eq(s->rules[0].match, "x*");
	ck_assert_double_eq(s->rules[0].warn, 0.5);
	config_free(&schema, data);
}
END_TEST

START_TEST(bad_files)
{
	static const struct { const char *text, *said; } bad[] = {
		{ "name: a\nrules:\n- match: b\n  warn: 1\n\n  wrong: 3\n", "line 6: Unexpected key: wrong" },
		{ "name: a\nrules:\n- match: b\n  warn: x\n", "line 4: Invalid FLOAT value: x" },
		{ "name: a\nrules: 7\n", "line 2: Expecting SEQUENCE" },
		{ "name: a\nname: b\n", "line 2: Mapping field already seen: name" },
		{ "\n\nfoo: a\n", "line 3: Unexpected key: foo" },
		{ "name: a\n\nrules:\n- warn: 3\n", "line 4: Missing required mapping field: match" },
		{ "", "empty" },
	};

	for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); i++) {
		void *data;

		ck_assert_int_eq(load(bad[i].text, &data), ERR_INPUT);
		ck_assert_msg(strstr(said, bad[i].said) && strstr(said, path), "%zu: %s", i, said);
		ck_assert_msg(strchr(said, '\n') == said + strlen(said) - 1, "not one line: %s", said);
	}
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("config");
	int failed, fd = mkstemp(path);

	if (fd < 0)
		return 1;
	close(fd);
	tcase_add_test(tests, a_good_file);
	tcase_add_test(tests, bad_files);
	failed = run_case(tests, "config");
	unlink(path);
	return failed != 0;
}
