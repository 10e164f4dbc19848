/** What the request, the scene or the adapter's images have wrong, as one sentence: exit code 2, where a fault has 3. */
export class Mistake extends Error {}
