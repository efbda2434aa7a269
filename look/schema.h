/* The keys of rule files: the libcyaml schema of struct rules (look/rules.h). All members but lists are pointers. */
#pragma once

#include "base/config.h"

extern const cyaml_schema_value_t rules_schema;
