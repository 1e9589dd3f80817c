#include <restir_embedded.h>

size_t standardShadeWords();
size_t standardShadeWords() { return kEmbeddedPasses[0].wordCount; }
