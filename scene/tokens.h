/* Names of the GL tokens in a scene's fields. */
#pragma once

#include <stdint.h>

enum { TOKEN_NAME_BYTES = 48 };

/**
 * The name of a token as the specification spells it ("GL_RGBA").
 * @param text  buffer for the number of a token that no scene field uses
 * @return a static string (0: "GL_NONE"), or text ("0x1234")
 */
const char *token_name(uint32_t token, char text[TOKEN_NAME_BYTES]);

/** As token_name, for a blend factor or stencil operation, where 0 and 1 are GL_ZERO and GL_ONE. */
const char *token_factor_name(uint32_t token, char text[TOKEN_NAME_BYTES]);
