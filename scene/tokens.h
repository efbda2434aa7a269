/* Names of the GL tokens that a scene's fields hold. */
#pragma once

#include <stdint.h>

enum { TOKEN_NAME_BYTES = 48 };

/**
 * The name of a token as the specification spells it ("GL_RGBA").
 * @param text  room for a number, where a scene has no such token
 * @return a static string, or text: "0x1234"
 */
const char *token_name(uint32_t token, char text[TOKEN_NAME_BYTES]);

/** The same of a blend factor or a stencil operation: 0 and 1 are GL_ZERO and GL_ONE there, elsewhere 0 is GL_NONE. */
const char *token_factor_name(uint32_t token, char text[TOKEN_NAME_BYTES]);
