/* The keys of rule files: the libcyaml schema of struct rules (look/rules/rules.h). */
#pragma once

#include "base/config.h"

extern const cyaml_schema_value_t rules_schema;
