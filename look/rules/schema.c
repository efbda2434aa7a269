#include "look/rules/schema.h"

#include "look/rules/rules.h"

#define OPTIONAL_POINTER (CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL)

static const cyaml_schema_value_t number = { CYAML_VALUE_FLOAT(CYAML_FLAG_DEFAULT, float) };

#define TEXT(type, name) CYAML_FIELD_STRING_PTR(#name, OPTIONAL_POINTER, type, name, 1, 256)
#define TRUTH(type, name) CYAML_FIELD_BOOL_PTR(#name, OPTIONAL_POINTER, type, name)
#define COUNT(type, name) CYAML_FIELD_UINT_PTR(#name, OPTIONAL_POINTER, type, name)
#define NUMBER(type, name) CYAML_FIELD_FLOAT_PTR(#name, OPTIONAL_POINTER, type, name)
#define NUMBERS(type, name, n) CYAML_FIELD_SEQUENCE_FIXED(#name, OPTIONAL_POINTER, type, name, &number, n)

static const cyaml_schema_field_t match_fields[] = {
	TEXT(struct match, texture), TEXT(struct match, mesh), TEXT(struct match, draws), TEXT(struct match, call),
	COUNT(struct match, list), TRUTH(struct match, program), TRUTH(struct match, lit), TRUTH(struct match, textured),
	TRUTH(struct match, blended), TRUTH(struct match, alpha_tested), TRUTH(struct match, depth_tested),
	TRUTH(struct match, stencil_tested), TRUTH(struct match, environment_mapped), TRUTH(struct match, multiplies),
	COUNT(struct match, units), TRUTH(struct match, parallel), TEXT(struct match, modelview),
	NUMBERS(struct match, in_plane, 4),
	CYAML_FIELD_END
};

/* `confidence` and the like; libcyaml sees them as keys of the rule itself. */
#define REASON(type) \
	CYAML_FIELD_STRING_PTR("role", OPTIONAL_POINTER, type, reason.role, 1, 64), \
	CYAML_FIELD_STRING_PTR("why", OPTIONAL_POINTER, type, reason.why, 1, 1000), \
	CYAML_FIELD_FLOAT_PTR("confidence", OPTIONAL_POINTER, type, reason.confidence), \
	CYAML_FIELD_SEQUENCE_FIXED("plane", OPTIONAL_POINTER, type, reason.plane, &number, 4)

static const cyaml_schema_field_t parameter_fields[] = {
	CYAML_FIELD_STRING_PTR("name", CYAML_FLAG_POINTER, struct parameter_rule, name, 1, 47),
	CYAML_FIELD_SEQUENCE("value", CYAML_FLAG_POINTER, struct parameter_rule, value, &number, 1, 4), CYAML_FIELD_END
};

static const cyaml_schema_value_t parameter_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct parameter_rule,
	                                                                   parameter_fields) };

#define PARAMETERS(type) \
	CYAML_FIELD_SEQUENCE("parameters", OPTIONAL_POINTER, type, parameters, &parameter_schema, 0, CYAML_UNLIMITED)

static const cyaml_schema_field_t repair_fields[] = {
	NUMBER(struct repair_rule, weld), TRUTH(struct repair_rule, turn), TRUTH(struct repair_rule, merge), CYAML_FIELD_END
};

static const cyaml_schema_field_t surface_fields[] = {
	REASON(struct surface_rule),
	CYAML_FIELD_MAPPING_PTR("match", OPTIONAL_POINTER, struct surface_rule, match, match_fields),
	NUMBER(struct surface_rule, reflect), NUMBER(struct surface_rule, transmit), NUMBER(struct surface_rule, ior),
	NUMBER(struct surface_rule, roughness), NUMBER(struct surface_rule, crease), NUMBERS(struct surface_rule, absorb, 3),
	NUMBERS(struct surface_rule, emission, 3), TRUTH(struct surface_rule, shadows), TRUTH(struct surface_rule, mirrors),
	TRUTH(struct surface_rule, near), TRUTH(struct surface_rule, shaded),
	TEXT(struct surface_rule, passes),
	CYAML_FIELD_MAPPING_PTR("repair", OPTIONAL_POINTER, struct surface_rule, repair, repair_fields),
	TRUTH(struct surface_rule, lit), TRUTH(struct surface_rule, dome), TRUTH(struct surface_rule, left_out),
	COUNT(struct surface_rule, lightmap), COUNT(struct surface_rule, shadow_unit), TRUTH(struct surface_rule, solid),
	TRUTH(struct surface_rule, vertex_light), PARAMETERS(struct surface_rule), CYAML_FIELD_END
};

static const cyaml_schema_field_t spot_fields[] = {
	NUMBERS(struct spot, direction, 3), NUMBER(struct spot, cutoff), NUMBER(struct spot, exponent), CYAML_FIELD_END
};

static const cyaml_schema_field_t anchor_fields[] = {
	TEXT(struct anchor, mesh), NUMBERS(struct anchor, at, 16), COUNT(struct anchor, part), CYAML_FIELD_END
};

static const cyaml_schema_field_t light_fields[] = {
	REASON(struct light_rule), TEXT(struct light_rule, space), TEXT(struct light_rule, on),
	COUNT(struct light_rule, light), TRUTH(struct light_rule, off), TEXT(struct light_rule, object),
	NUMBERS(struct light_rule, position, 4), NUMBERS(struct light_rule, ambient, 3),
	NUMBERS(struct light_rule, diffuse, 3), NUMBERS(struct light_rule, specular, 3),
	NUMBERS(struct light_rule, attenuation, 3), NUMBER(struct light_rule, radius), TRUTH(struct light_rule, shadows),
	CYAML_FIELD_MAPPING_PTR("spot", OPTIONAL_POINTER, struct light_rule, spot, spot_fields), CYAML_FIELD_END
};

static const cyaml_schema_field_t unseen_fields[] = {
	REASON(struct unseen_rule), COUNT(struct unseen_rule, frame),
	CYAML_FIELD_STRING_PTR("draws", OPTIONAL_POINTER, struct unseen_rule, draws, 1, 1 << 20), CYAML_FIELD_END
};

static const cyaml_schema_field_t sky_fields[] = {
	REASON(struct sky_rule), NUMBER(struct sky_rule, reach), NUMBERS(struct sky_rule, up, 3), TEXT(struct sky_rule, space),
	NUMBERS(struct sky_rule, light, 3), NUMBERS(struct sky_rule, ground, 3), NUMBER(struct sky_rule, lit),
	TRUTH(struct sky_rule, unlit), CYAML_FIELD_END
};

static const cyaml_schema_field_t gloss_fields[] = { REASON(struct gloss_rule), NUMBER(struct gloss_rule, share),
	                                             CYAML_FIELD_END };

static const cyaml_schema_value_t surface_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct surface_rule,
                                                                         surface_fields) };
static const cyaml_schema_value_t light_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct light_rule,
                                                                       light_fields) };

static const cyaml_schema_value_t anchor_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct anchor,
	                                                                anchor_fields) };

static const cyaml_schema_value_t unseen_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct unseen_rule,
	                                                                unseen_fields) };

static const cyaml_schema_field_t rules_fields[] = {
	CYAML_FIELD_SEQUENCE("surfaces", OPTIONAL_POINTER, struct rules, surfaces, &surface_schema, 0, CYAML_UNLIMITED),
	CYAML_FIELD_SEQUENCE("lights", OPTIONAL_POINTER, struct rules, lights, &light_schema, 0, CYAML_UNLIMITED),
	CYAML_FIELD_SEQUENCE("world", OPTIONAL_POINTER, struct rules, world, &anchor_schema, 0, CYAML_UNLIMITED),
	CYAML_FIELD_SEQUENCE("unseen", OPTIONAL_POINTER, struct rules, unseen, &unseen_schema, 0, CYAML_UNLIMITED),
	CYAML_FIELD_MAPPING_PTR("sky", OPTIONAL_POINTER, struct rules, sky, sky_fields),
	CYAML_FIELD_MAPPING_PTR("gloss", OPTIONAL_POINTER, struct rules, gloss, gloss_fields),
	TRUTH(struct rules, spare), TRUTH(struct rules, replace), PARAMETERS(struct rules),
	CYAML_FIELD_END
};

const cyaml_schema_value_t rules_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, struct rules,
	                                                               rules_fields) };
