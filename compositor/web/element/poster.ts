// Cover of the view until the object is revealed: the poster, as <model-viewer> has it. With reveal="manual" the page
// dismisses it.

export class Poster {
  /** True while the view is hidden. */
  shown = true;
  private dismissed = false;

  /**
   * @param host the element, which receives the events
   * @param cover element of the shadow tree with the poster
   * @param covered elements of the shadow tree that are hidden meanwhile
   */
  constructor(
    private readonly host: HTMLElement,
    private readonly cover: HTMLElement,
    private readonly covered: HTMLElement[],
  ) {}

  /** Covers the view until dismiss(). */
  show(): void {
    this.dismissed = false;
    this.set(true);
  }

  /** Covers the view until another object is there. */
  reset(): void {
    this.set(true);
  }

  /** Reveals the view, at once or as soon as there is one. */
  dismiss(hasView: boolean): void {
    this.dismissed = true;
    if (hasView) this.set(false);
  }

  /** Called with the first view. */
  ready(): void {
    if (this.dismissed || this.host.getAttribute("reveal") !== "manual") this.set(false);
  }

  private set(shown: boolean): void {
    if (shown === this.shown) return;
    this.shown = shown;
    this.cover.hidden = !shown;
    for (const element of this.covered) element.classList.toggle("concealed", shown);
    if (!shown) this.host.dispatchEvent(new CustomEvent("poster-dismissed"));
    this.host.dispatchEvent(new CustomEvent("model-visibility", { detail: { visible: !shown } }));
  }
}
