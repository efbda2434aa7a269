/* The keys of rule files, as libcyaml reads them into struct rules (look/rules.h). All but lists are pointers. */
#pragma once

#include "base/config.h"

extern const cyaml_schema_value_t rules_schema;
