/* Converts findings to rules, exactly as if findings_write had written them to a file and rules_load had read it. */
#pragma once

#include "look/rules/findings.h"
#include "look/rules/rules.h"

/**
 * @param out  receives the rules; free with config_free and rules_schema. NULL on failure
 * @return 0 or ERR_SYSTEM (reported)
 */
int adopted_create(const struct findings *findings, struct rules **out);
