/* Findings as the structs that rules_load would read from their file. */
#pragma once

#include "look/findings.h"
#include "look/rules.h"

/** @param out  receives the rules; config_free with rules_schema. @return 0 or ERR_SYSTEM (reported; NULL then) */
int adopted_create(const struct findings *findings, struct rules **out);
