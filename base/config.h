/*
 * Configuration files: YAML, checked against a libcyaml schema. An unknown key, a wrong type or a value out of range is
 * an error that names the file and the line.
 */
#pragma once

#include <cyaml/cyaml.h>

/**
 * Load a file.
 *
 * @param schema  its root must be a pointer (CYAML_FLAG_POINTER) to a mapping
 * @param out     receives the data; free with config_free and the same schema. (libyaml owns the prefix yaml_.)
 * @return 0; ERR_INPUT (reported with its line: missing, not YAML, or against the schema); ERR_SYSTEM (reported)
 */
int config_load(const char *path, const cyaml_schema_value_t *schema, void **out);

/** The same for text in memory. @param name  for messages */
int config_parse(const char *name, const char *text, size_t n, const cyaml_schema_value_t *schema, void **out);
void config_free(const cyaml_schema_value_t *schema, void *data);
