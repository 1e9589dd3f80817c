#include <restir_embedded.h>

size_t standardShadeWords();
size_t standardShadeWords() { return kEmbeddedPack.modules[0].wordCount; }
