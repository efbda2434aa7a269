/* Base64 (RFC 4648 sec. 4), for pages that embed their pictures. */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/** A multiple of three bytes can be followed by another call. */
void base64_write(const uint8_t *bytes, size_t n, FILE *out);

/**
 * A data URL (RFC 2397).
 * @param type  "image/png"
 * @return its text, to be freed with free(); NULL: out of memory (reported)
 */
char *base64_url(const char *type, const uint8_t *bytes, size_t n);
